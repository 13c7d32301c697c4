// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QThreadPool>
#include <memory>
#include <stop_token>

#include "views/cloud_scene.h"

namespace lvcalib::widgets {

/// Builds cloud scenes on a thread of its own. A new request stops the one before; only the newest
/// result is delivered, on the thread of this object.
class CloudSceneBuilder : public QObject {
  Q_OBJECT

 public:
  explicit CloudSceneBuilder(QObject* parent = nullptr);
  ~CloudSceneBuilder() override;

  void request(CloudSceneInput input);
  /// True while a result is awaited.
  [[nodiscard]] bool busy() const { return busy_; }

 Q_SIGNALS:
  void ready(std::shared_ptr<const lvcalib::widgets::CloudScene> scene);

 private:
  void startNext();

  std::unique_ptr<CloudSceneInput> next_;
  int newest_ = 0;
  bool running_ = false;
  bool busy_ = false;
  std::stop_source stop_;  // Of the one that runs.
  QThreadPool pool_;       // One thread.
};

}  // namespace lvcalib::widgets
