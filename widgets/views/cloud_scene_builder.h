// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QThreadPool>
#include <memory>
#include <optional>
#include <stop_token>

#include "views/cloud_scene.h"

namespace lvcalib::widgets {

/// Builds cloud scenes on a thread of its own. A new request stops the one before; only the newest
/// result is delivered, on the thread of this object. Where the board is to be looked for, the
/// scene comes twice: at once, and with the board once it is found.
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
  // By the pool's thread.
  void build(const CloudSceneInput& input, int number, const std::stop_token& stop);
  void deliver(int number, std::shared_ptr<const CloudScene> scene, bool last);

  std::unique_ptr<CloudSceneInput> next_;
  int newest_ = 0;
  bool running_ = false;
  bool busy_ = false;
  std::stop_source stop_;  // Of the one that runs.
  // What was found in the cloud looked at last: only the pool's thread touches it.
  std::weak_ptr<const Cloud> sought_in_;
  std::optional<Rigid3> sought_;
  QThreadPool pool_;  // One thread.
};

}  // namespace lvcalib::widgets
