// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/runner.h"

#include <QTimer>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace lvcalib::widgets {
namespace {

// Counts the worker threads of the process.
struct Workers {
  std::mutex mutex;
  std::condition_variable ended;
  int count = 0;
};

Workers& workers() {
  static Workers* const all = new Workers;  // Outlives abandoned threads at the program's end.
  return *all;
}

}  // namespace

struct Runner::Task {
  quint64 id = 0;
  std::stop_source stop;
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
  {
    const std::lock_guard lock(workers().mutex);
    ++workers().count;
  }
  std::thread([mailbox = mailbox_, task = task_, work = std::move(work), this]() mutable {
    RunContext context;
    context.stop = task->stop.get_token();
    context.progress = [mailbox, task, this](const Progress& p) {
      if (task->stop.stop_requested()) return;
      mailbox->post([this, task, p] {
        if (task != task_) return;
        Q_EMIT progressed(task->id, QString::fromStdString(p.stage), p.fraction,
                          QString::fromStdString(p.text));
      });
    };
    const Post post = [mailbox, task, this](Deliver call) {
      if (task->stop.stop_requested()) return;
      mailbox->post([this, task, call = std::move(call)] {
        if (task == task_) call();
      });
    };
    Deliver deliver;
    QString error;
    try {
      deliver = work(context, post);
    } catch (const std::exception& e) {
      error = QString::fromUtf8(e.what());
      if (error.isEmpty()) error = QStringLiteral("exception");
    } catch (...) {
      error = QStringLiteral("exception of unknown type");
    }
    work = {};  // What the job held goes before the thread counts as ended.
    mailbox->post(
        [this, task, deliver = std::move(deliver), error] { take(task, deliver, error); });
    const std::lock_guard lock(workers().mutex);
    --workers().count;
    workers().ended.notify_all();
  }).detach();
  Q_EMIT started(id_);
  return id_;
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

void Runner::take(const std::shared_ptr<Task>& task, const Deliver& deliver, const QString& error) {
  if (task != task_) return;  // Abandoned.
  const bool stopped = task->stop.stop_requested();
  task_.reset();
  if (deliver) deliver();
  if (stopped) {
    Q_EMIT cancelled(task->id);
  } else if (!error.isEmpty()) {
    Q_EMIT failed(task->id, error);
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
  std::unique_lock lock(workers().mutex);
  return workers().ended.wait_for(lock, std::chrono::milliseconds(milliseconds),
                                  [] { return workers().count == 0; });
}

}  // namespace lvcalib::widgets
