// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_scene_builder.h"

#include <exception>
#include <new>
#include <utility>

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
    const auto scene = built_scene(*input, stop);
    QMetaObject::invokeMethod(
        this,
        [this, number, scene] {
          running_ = false;
          if (next_) {
            startNext();
          } else if (number == newest_ && scene) {
            busy_ = false;
            Q_EMIT ready(scene);
          }
        },
        Qt::QueuedConnection);
  });
}

}  // namespace lvcalib::widgets
