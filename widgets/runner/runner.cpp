// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/runner.h"

#include <QCoreApplication>
#include <QDeadlineTimer>
#include <QThread>
#include <QTimer>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <sys/resource.h>

#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

const QString kWorkerName = QStringLiteral("runner_worker");

// The thread of one job. The application owns it, not the runner: an abandoned job outlives its
// runner, and is stopped and joined at the latest when the application goes.
class Worker final : public QThread {
 public:
  Worker(std::stop_source stop, std::function<void()> job)
      : QThread(QCoreApplication::instance()), stop_(std::move(stop)), job_(std::move(job)) {
    setObjectName(kWorkerName);
    connect(this, &QThread::finished, this, &QObject::deleteLater);
  }
  ~Worker() override {
    stop_.request_stop();
    wait();
  }

 protected:
  // What the job holds goes with it, in its thread. Threads that the job starts inherit its place
  // behind those that draw the window.
  void run() override {
    constexpr int kBehind = 10;  // Half of the way to the last place.
    // On Linux of the calling thread alone.
    ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kBehind);
    std::exchange(job_, {})();
  }

 private:
  std::stop_source stop_;
  std::function<void()> job_;
};

// What became of a call that may throw: why it failed, empty if it did not.
QString complaint_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& e) {
    const QString what = QString::fromUtf8(e.what());
    return what.isEmpty() ? QStringLiteral("exception") : what;
  } catch (...) {
    return QStringLiteral("exception of unknown type");
  }
  return {};
}

}  // namespace

struct Runner::Task {
  quint64 id = 0;
  std::stop_source stop;
  std::mutex mutex;                // Of what follows.
  std::optional<Progress> latest;  // Not told yet: a telling is on its way.
  std::set<std::string> stages;    // That have begun.
};

// The way back to the runner's thread, cut when the runner goes away.
struct Runner::Mailbox {
  std::mutex mutex;
  Runner* receiver = nullptr;

  template <class Call>
  void post(Call call) {
    const std::lock_guard lock(mutex);
    if (receiver != nullptr) QMetaObject::invokeMethod(receiver, call, Qt::QueuedConnection);
  }
};

Runner::Runner(QObject* parent) : QObject(parent), mailbox_(std::make_shared<Mailbox>()) {
  mailbox_->receiver = this;
}

Runner::~Runner() {
  abandon();
  const std::lock_guard lock(mailbox_->mutex);
  mailbox_->receiver = nullptr;
}

quint64 Runner::start(Work work) {
  if (task_) {
    const quint64 old = task_->id;
    abandon();
    Q_EMIT cancelled(old);
  }
  task_ = std::make_shared<Task>();
  task_->id = ++id_;
  auto* worker = new Worker(
      task_->stop, [mailbox = mailbox_, task = task_, work = std::move(work), this]() mutable {
        RunContext context;
        context.stop = task->stop.get_token();
        context.progress = [mailbox, task, this](const Progress& p) {
          if (task->stop.stop_requested()) return;
          const std::lock_guard lock(task->mutex);
          if (task->stages.insert(p.stage).second) {
            task->latest.reset();  // What was before it is past.
            mailbox->post([this, task, p] { tell(task, p); });
            return;
          }
          const bool on_its_way = task->latest.has_value();
          task->latest = p;
          if (!on_its_way) mailbox->post([this, task] { tell_latest(task); });
        };
        const Post post = [mailbox, task, this](Deliver call) {
          if (task->stop.stop_requested()) return;
          mailbox->post([this, task, call = std::move(call)] {
            if (task == task_ && !task->stop.stop_requested()) call();
          });
        };
        Deliver deliver;
        const QString error = complaint_of([&] { deliver = work(context, post); });
        work = {};  // What the job held goes before its results are handed over.
        mailbox->post(
            [this, task, deliver = std::move(deliver), error] { take(task, deliver, error); });
      });
  worker->start();
  // Without a thread nobody else would say that nothing comes of it.
  if (!worker->isRunning() && !worker->isFinished()) {
    delete worker;
    mailbox_->post([this, task = task_] {
      take(task, {}, QStringLiteral("the system has no thread left for it"));
    });
  }
  Q_EMIT started(id_);
  return id_;
}

Error Runner::unexpected(const QString& message, std::string where, Message advice) {
  return Error::untrusted(
      Message("an unexpected error stopped the work: %1", message.toStdString()), std::move(where),
      std::move(advice));
}

void Runner::cancel() {
  if (!task_) return;
  task_->stop.request_stop();
  QTimer::singleShot(kPatienceMs, Qt::PreciseTimer, this, [this, task = task_] {
    if (task != task_) return;
    abandon();
    Q_EMIT cancelled(task->id);
  });
}

void Runner::tell(const std::shared_ptr<Task>& task, const Progress& p) {
  if (task != task_) return;
  told_.start();
  Q_EMIT progressed(task->id, QString::fromStdString(p.stage), p.fraction, core_text(p.text));
}

void Runner::tell_latest(const std::shared_ptr<Task>& task) {
  if (task != task_) return;
  if (told_.elapsed() < kTellEveryMs) {  // Its stage's beginning was told before.
    QTimer::singleShot(kTellEveryMs - told_.elapsed(), this, [this, task] { tell_latest(task); });
    return;
  }
  std::optional<Progress> latest;
  {
    const std::lock_guard lock(task->mutex);
    latest = std::exchange(task->latest, {});
  }
  if (latest) tell(task, *latest);
}

void Runner::take(const std::shared_ptr<Task>& task, const Deliver& deliver, const QString& error) {
  if (task != task_) return;  // Abandoned.
  const bool stopped = task->stop.stop_requested();
  task_.reset();
  const QString complaint = deliver ? complaint_of(deliver) : error;
  if (stopped) {
    Q_EMIT cancelled(task->id);
  } else if (!complaint.isEmpty()) {
    Q_EMIT failed(task->id, complaint);
  } else {
    Q_EMIT finished(task->id);
  }
}

void Runner::abandon() {
  if (!task_) return;
  task_->stop.request_stop();
  task_.reset();
}

bool Runner::wait_for_workers(int milliseconds) {
  const QDeadlineTimer end(milliseconds);  // Negative: never.
  const auto workers =
      QCoreApplication::instance()->findChildren<QThread*>(kWorkerName, Qt::FindDirectChildrenOnly);
  bool all = true;
  for (QThread* worker : workers) all = worker->wait(end) && all;
  return all;
}

}  // namespace lvcalib::widgets

#include "moc_runner.cpp"
