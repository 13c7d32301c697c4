// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <cstdint>
#include <functional>
#include <memory>

#include "base/error.h"
#include "base/progress.h"

namespace lvcalib::widgets {

/// Runs one job at a time in a thread of its own (QThread). A job gets a RunContext (progress, stop
/// token) and returns a function that is then called in the thread of the runner, to hand over its
/// results.
///
/// A new job takes the place of a running one; cancel() gives the running one kPatience to stop.
/// A job that does not stop in time is abandoned: it runs to its end unseen and its results are
/// dropped, so that two runs never mix and nobody waits for it. Exceptions become failed(). The
/// threads belong to the application, which joins them when it ends.
class Runner : public QObject {
  Q_OBJECT

 public:
  /// Called in the runner's thread; may be empty.
  using Deliver = std::function<void()>;
  /// Hands something over while the job still runs; dropped once the job is abandoned or stopped.
  using Post = std::function<void(Deliver)>;
  using Work = std::function<Deliver(const RunContext&, const Post&)>;

  /// How long a cancelled job may take to stop before it is abandoned.
  static constexpr int kPatienceMs = 100;
  /// Ten times a second looks like moving; without a graphics card a window that is drawn again
  /// takes 20 to 60 ms of the machine.
  static constexpr int kTellEveryMs = 100;

  /// In the application's own thread.
  explicit Runner(QObject* parent = nullptr);
  /// Abandons what runs.
  ~Runner() override;

  /// Starts a job and returns its id; ids grow. cancelled() is said of a running one, unless it was
  /// abandoned before.
  quint64 start(Work work);
  /// Asks the running job to stop. cancelled() follows within kPatienceMs. What the job delivers
  /// in that time is still handed over (it may have kept finished stages).
  void cancel();
  /// Drops the running job at once: nothing of it is handed over, and no signal follows.
  void abandon();
  [[nodiscard]] bool running() const { return task_ != nullptr; }
  [[nodiscard]] quint64 current() const { return id_; }

  /// How the message of failed() is told.
  [[nodiscard]] static Error unexpected(const QString& message, std::string where = {},
                                        Message advice = {});

  /// Waits until the threads of all jobs, abandoned ones too, have ended; false after the time.
  /// Negative: as long as it takes. For the end of a program, before what the jobs use is torn
  /// down.
  static bool wait_for_workers(int milliseconds);

 Q_SIGNALS:
  void started(quint64 id);
  /// `fraction` 0…1 of the whole job. The beginning of every stage, and between these the latest at
  /// most every kTellEveryMs: each draws the window again.
  void progressed(quint64 id, const QString& stage, double fraction, const QString& text);
  void finished(quint64 id);
  void cancelled(quint64 id);
  /// The job threw; `message` says what.
  void failed(quint64 id, const QString& message);

 private:
  struct Task;
  struct Mailbox;
  void tell(const std::shared_ptr<Task>& task, const Progress& p);
  void tell_latest(const std::shared_ptr<Task>& task);
  void take(const std::shared_ptr<Task>& task, const Deliver& deliver, const QString& error);

  std::shared_ptr<Mailbox> mailbox_;
  std::shared_ptr<Task> task_;
  QElapsedTimer told_;  // Since the running job's last progressed().
  quint64 id_ = 0;
};

/// Tells an unexpected failure by the signals failed() and ended() of the `work` that a runner
/// does.
template <class W>
void relay_failure(const Runner& runner, W* work) {
  QObject::connect(&runner, &Runner::failed, work, [work](quint64, const QString& message) {
    Q_EMIT work->failed(Runner::unexpected(message));
    Q_EMIT work->ended();
  });
}

/// The same, and its progress and its end by progressed() and ended(). What follows a cancelled job
/// is left to `work`.
template <class W>
void relay(const Runner& runner, W* work) {
  QObject::connect(&runner, &Runner::progressed, work,
                   [work](quint64, const QString&, double fraction, const QString& text) {
                     Q_EMIT work->progressed(fraction, text);
                   });
  QObject::connect(&runner, &Runner::finished, work, &W::ended);
  relay_failure(runner, work);
}

}  // namespace lvcalib::widgets
