// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_scene_builder.h"

#include <new>

namespace lvcalib::widgets {

CloudSceneBuilder::CloudSceneBuilder(QObject* parent) : QObject(parent) {}

CloudSceneBuilder::~CloudSceneBuilder() = default;  // The jthread stops and joins.

void CloudSceneBuilder::request(CloudSceneInput input) {
  next_ = std::make_unique<CloudSceneInput>(std::move(input));
  busy_ = true;
  ++newest_;
  if (running_) {
    worker_.request_stop();
  } else {
    startNext();
  }
}

void CloudSceneBuilder::startNext() {
  running_ = true;
  // The former thread has posted its last event, so joining it does not wait.
  worker_ = std::jthread(
      [this, number = newest_,
       input = std::shared_ptr<CloudSceneInput>(std::move(next_))](std::stop_token stop) {
        std::shared_ptr<const CloudScene> scene;
        try {
          scene = build_cloud_scene(*input, std::move(stop));
        } catch (const std::bad_alloc&) {
          auto empty = std::make_shared<CloudScene>();
          empty->notice = tr("There is not enough memory to show this cloud.");
          scene = empty;
        }
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
