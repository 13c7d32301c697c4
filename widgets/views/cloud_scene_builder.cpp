// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_scene_builder.h"

#include <exception>
#include <new>
#include <utility>

#include "localization/board_search.h"

namespace lvcalib::widgets {
namespace {

std::shared_ptr<const CloudScene> scene_with(const QString& notice) {
  auto empty = std::make_shared<CloudScene>();
  empty->notice = notice;
  return empty;
}

// A failure is a scene that says so: whoever waits for one gets it.
std::shared_ptr<const CloudScene> built_scene(const CloudSceneInput& input,
                                              const std::stop_token& stop) {
  try {
    return build_cloud_scene(input, stop);
  } catch (const std::bad_alloc&) {
    return scene_with(CloudSceneBuilder::tr("There is not enough memory to show this cloud."));
  } catch (const std::exception& e) {
    return scene_with(
        CloudSceneBuilder::tr("This cloud cannot be shown: %1").arg(QString::fromUtf8(e.what())));
  }
}

// A first look may go without it.
std::optional<Rigid3> sought_board(const CloudSceneInput& input, const RunContext& context) {
  try {
    return likely_board(*input.full, input.target, context);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::shared_ptr<const CloudScene> with_likely_board(std::shared_ptr<const CloudScene> scene,
                                                    const CloudSceneInput& input,
                                                    const std::optional<Rigid3>& board) {
  if (!board) return scene;
  auto out = std::make_shared<CloudScene>(*scene);
  out->place_board(*board, input.target.outline());
  out->board_is_likely = true;
  return out;
}

}  // namespace

CloudSceneBuilder::CloudSceneBuilder(QObject* parent) : QObject(parent) {
  pool_.setMaxThreadCount(1);
}

CloudSceneBuilder::~CloudSceneBuilder() {
  stop_.request_stop();
  pool_.waitForDone();
}

void CloudSceneBuilder::request(CloudSceneInput input) {
  next_ = std::make_unique<CloudSceneInput>(std::move(input));
  busy_ = true;
  ++newest_;
  if (running_) {
    stop_.request_stop();
  } else {
    startNext();
  }
}

void CloudSceneBuilder::startNext() {
  running_ = true;
  stop_ = {};
  pool_.start([this, number = newest_, stop = stop_.get_token(),
               input = std::shared_ptr<CloudSceneInput>(std::move(next_))] {
    build(*input, number, stop);
  });
}

void CloudSceneBuilder::build(const CloudSceneInput& input, int number,
                              const std::stop_token& stop) {
  const auto scene = built_scene(input, stop);
  const bool seeks = scene && scene->cloud && input.full && input.seek_board && !input.refinement;
  if (!seeks) {
    deliver(number, scene, true);
    return;
  }
  if (sought_in_.lock() != input.full) {
    deliver(number, scene, false);
    RunContext context;
    context.stop = stop;
    const auto board = sought_board(input, context);
    if (!stop.stop_requested()) {
      sought_in_ = input.full;
      sought_ = board;
    }
  }
  deliver(number, stop.stop_requested() ? nullptr : with_likely_board(scene, input, sought_), true);
}

void CloudSceneBuilder::deliver(int number, std::shared_ptr<const CloudScene> scene, bool last) {
  QMetaObject::invokeMethod(
      this,
      [this, number, scene = std::move(scene), last] {
        if (last) running_ = false;
        if (last && next_) {
          startNext();
        } else if (number == newest_ && scene) {
          busy_ = !last;
          Q_EMIT ready(scene);
        }
      },
      Qt::QueuedConnection);
}

}  // namespace lvcalib::widgets

#include "moc_cloud_scene_builder.cpp"
