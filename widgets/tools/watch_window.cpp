// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/watch_window.h"

#include <QDir>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "design/board_grid.h"
#include "runner/workspace.h"
#include "style/texts.h"
#include "style/theme.h"
#include "tools/plan_text.h"
#include "views/board_sketch.h"
#include "views/large_text.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// Letters are read with ease if they subtend 20 to 22 minutes of arc (ISO 9241-303, preferred
// height of characters): 6 mm for each metre, 12 mm from two metres. Capitals are 0.7 of a font's
// size high, of which a point is 0.353 mm: 49 points. Texts that fit grow beyond, so that a large
// screen is read from farther away; only long sentences of reasons become smaller.
constexpr double kMost_pt = 96.0;
constexpr double kMostOfState_pt = 49.0;

// What is said of a file, without its name: see Error::sentence().
std::optional<Message> without_place(const Message& sentence, const std::filesystem::path& file) {
  const std::vector<Message>& parts = sentence.arguments();
  if (parts.size() != 2) return std::nullopt;
  if (parts[0] == Message::verbatim(file.string())) return parts[1];
  const auto placed = without_place(parts[0], file);
  if (!placed) return std::nullopt;
  return Message("%1 (%2)", *placed, parts[1]);
}

// A reason without the file that it begins with: the scene is named already, and the words count.
QString short_reason(const Message& reason, const Dataset& dataset, const std::string& scene) {
  for (const SceneFiles& files : dataset.scenes) {
    if (files.name != scene) continue;
    for (const std::filesystem::path& file : {files.image, files.cloud}) {
      if (const auto words = without_place(reason, file)) return core_text(*words);
    }
  }
  return core_text(reason);
}

}  // namespace

WatchWindow::WatchWindow(Workspace& workspace, WatchWork& watch, QWidget* parent)
    : QWidget(parent, Qt::Window), workspace_(workspace), watch_(watch) {
  setObjectName(QStringLiteral("watch_window"));
  setAttribute(Qt::WA_DeleteOnClose);
  build();
  connectParts();
  follow_language(this, [this] { retranslate(); });
  askNext();
}

WatchWindow::~WatchWindow() {
  plan_.disconnect(this);
}

void WatchWindow::build() {
  resize(1240, 660);
  const auto text = [this](const char* name, double most_pt) {
    auto* out = new LargeText(most_pt, this);
    out->setObjectName(QString::fromLatin1(name));
    return out;
  };
  scenes_ = text("watch_scenes", kMostOfState_pt);
  news_ = text("watch_last", kMostOfState_pt);
  sigma_ = text("watch_sigma", kMostOfState_pt);
  pose_ = text("watch_next", kMost_pt);
  sketch_ = new BoardSketch(this);
  sketch_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  pending_ = new QLabel(this);
  pending_->setObjectName(QStringLiteral("watch_pending"));
  pending_->setTextFormat(Qt::PlainText);
  pending_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  QFont font = pending_->font();
  font.setPointSizeF(1.4 * font.pointSizeF());
  pending_->setFont(font);
  full_ = new QPushButton(this);
  full_->setObjectName(QStringLiteral("watch_full_screen"));
  full_->setCheckable(true);
  full_->setShortcut(Qt::Key_F11);
  stop_ = new QPushButton(this);
  stop_->setObjectName(QStringLiteral("watch_stop"));
  auto* head = new QHBoxLayout;
  head->setSpacing(32);
  head->addWidget(scenes_, 1);
  head->addWidget(news_, 3);
  auto* middle = new QHBoxLayout;
  middle->setSpacing(16);
  middle->addWidget(sketch_, 5);
  middle->addWidget(pose_, 6);
  auto* foot = new QHBoxLayout;
  foot->addWidget(pending_, 1);
  foot->addWidget(full_);
  foot->addWidget(stop_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(head, 3);
  layout->addLayout(middle, 12);
  layout->addWidget(sigma_, 3);
  layout->addLayout(foot);
}

void WatchWindow::connectParts() {
  connect(full_, &QPushButton::toggled, this, &WatchWindow::showFullScreenWanted);
  connect(stop_, &QPushButton::clicked, this, [this] { watch_.stop(); });
  connect(&watch_, &WatchWork::changed, this, &WatchWindow::showAll);
  connect(&watch_, &WatchWork::looked, this, &WatchWindow::showAll);
  connect(&watch_, &WatchWork::arrived, this, [this](const QStringList& scenes) {
    last_ = Last::kSolving;
    last_name_ = scenes.isEmpty() ? QString() : scenes.last();
    no_result_.reset();
    // What is shown has perhaps just been done.
    next_.reset();
    plan_.cancel();
    showAll();
  });
  connect(&watch_, &WatchWork::refused, this, [this](const QString& name, const Message& reason) {
    last_ = Last::kRefused;
    last_name_ = name;
    last_reason_ = reason;
    showAll();
  });
  connect(&workspace_, &Workspace::result_changed, this, [this] {
    no_result_.reset();
    if (last_ == Last::kSolving) last_ = Last::kSolved;
    askNext();
  });
  connect(&workspace_, &Workspace::failed, this, [this](const Error& error, bool modest) {
    if (modest) return;
    no_result_ = error;
    if (watch_.ranLast()) last_ = Last::kSolved;
    askNext();
  });
  // Cancelled by the user.
  connect(&workspace_, &Workspace::run_ended, this, [this] {
    if (last_ != Last::kSolving || workspace_.up_to_date()) return;
    last_ = Last::kNone;
    askNext();
  });
  connect(&workspace_, &Workspace::decisions_changed, this, &WatchWindow::showAll);
  connect(&plan_, &PlanWork::ready, this, [this](const std::shared_ptr<const ScenePlan>& plan) {
    if (!plan->scenes.empty()) next_ = plan->scenes.front().pose;
  });
  connect(&plan_, &PlanWork::failed, this, [this](const Error& error) { no_plan_ = error; });
  connect(&plan_, &PlanWork::ended, this, &WatchWindow::showAll);
}

void WatchWindow::askNext() {
  next_.reset();
  no_plan_.reset();
  plan_.cancel();
  const auto result = workspace_.result();
  if (workspace_.is_open() && result && result->forward) {
    PlanRequest request;
    request.target = result->target;
    request.camera = result->camera;
    request.result = result;
    request.go_on = true;
    request.options.scenes = 1;
    for (const SceneFiles& files : workspace_.dataset().scenes)
      if (!files.cloud.empty()) request.cloud = files.cloud;
    plan_.request(request);
  }
  showAll();
}

bool WatchWindow::sureEnough() const {
  const auto result = workspace_.result();
  if (!result) return false;
  const QualityOptions& q = result->options.quality;
  const Matrix6d& covariance = result->covariance_total;
  return sigma_mm(covariance) <= 1e3 * q.tolerance_m &&
         sigma_mrad(covariance) <= 1e3 * q.tolerance_rad;
}

QString WatchWindow::sigmaText() const {
  const auto result = workspace_.result();
  if (!result) return tr("No result yet");
  const QualityOptions& q = result->options.quality;
  const Matrix6d& covariance = result->covariance_total;
  return tr("σ %1 of %2 mm, %3 of %4 mrad")
      .arg(sigma_text(sigma_mm(covariance)), QString::number(1e3 * q.tolerance_m, 'g', 3),
           sigma_text(sigma_mrad(covariance)), QString::number(1e3 * q.tolerance_rad, 'g', 3));
}

WatchWindow::News WatchWindow::news() const {
  switch (last_) {
    case Last::kSolving:
      return {tr("%1 is being solved …").arg(last_name_), {}};
    case Last::kRefused:
      return {tr("%1 not taken: %2").arg(last_name_, core_text(last_reason_)), false};
    case Last::kSolved: {
      if (no_result_)
        return {tr("%1: no result: %2").arg(last_name_, core_text(no_result_->message)), false};
      const auto result = workspace_.result();
      for (std::size_t k = 0; result && k < result->scenes.size(); ++k) {
        const SceneResult& scene = result->scenes[k];
        if (scene.name != last_name_.toStdString()) continue;
        if (scene.used) return {tr("%1 is taken").arg(last_name_), true};
        const QString reason = short_reason(scene.reason, workspace_.dataset(), scene.name);
        return {tr("%1 not taken: %2").arg(last_name_, reason), false};
      }
      return {};
    }
    default:
      return {watch_.watching() ? tr("Waiting for the next scene") : QString(), {}};
  }
}

QString WatchWindow::pendingText() const {
  if (!watch_.watching()) return tr("Watching has ended");
  if (watch_.pending().empty())
    return tr("Watching %1").arg(QDir::toNativeSeparators(watch_.folder()));
  const PendingPair& first = watch_.pending().front();
  QString out = first.name.empty()
                    ? core_text(first.reason)
                    : tr("%1 %2").arg(QString::fromStdString(first.name), core_text(first.reason));
  const auto more = static_cast<int>(watch_.pending().size()) - 1;
  if (more > 0) out += QLatin1Char(' ') + tr("(and %1 more)").arg(more);
  return out;
}

void WatchWindow::showAll() {
  const auto result = workspace_.result();
  const auto all = static_cast<int>(workspace_.dataset().scenes.size());
  const int used = result ? static_cast<int>(result->extrinsic.used_scenes) : 0;
  scenes_->setText(used == all ? tr("Scenes: %1").arg(all)
                               : tr("Scenes: %1/%2").arg(used).arg(all));
  const News last = news();
  const StateColors colors = state_colors(palette());
  news_->setText(last.text);
  news_->setColor(!last.good ? QColor() : *last.good ? colors.good : colors.bad);
  // Told by a sign as well as by its colour.
  sigma_->setText(sureEnough() ? sigmaText() + QStringLiteral(" \u2713") : sigmaText());
  sigma_->setColor(sureEnough() ? colors.good : QColor());
  sigma_->setToolTip(
      tr("One standard deviation of the extrinsic's position and rotation in total, and the "
         "tolerance of each (Parameters)"));
  const QString pending = pendingText();
  pending_->setText(pending);
  pending_->setToolTip(pending);
  stop_->setEnabled(watch_.watching());
  showNext();
}

void WatchWindow::showNext() {
  if (!workspace_.is_open()) return;
  const Dataset& dataset = workspace_.dataset();
  const auto result = workspace_.result();
  const Camera& camera = result ? result->camera : dataset.camera;
  if (next_) {
    // Each thing to do on a line of its own.
    const QStringList parts = board_place_parts(*next_);
    QString words = parts.mid(0, 2).join(tr(", "));
    for (const QString& part : parts.mid(2)) words += QLatin1Char('\n') + part;
    pose_->setText(tr("Next: %1").arg(words));
    sketch_->setPose(dataset.target, camera, next_->camera_from_board);
    return;
  }
  if (plan_.busy() || workspace_.busy()) {
    pose_->setText(last_ == Last::kSolving ? tr("Stand by …") : tr("Looking for the next pose …"));
    sketch_->setPose(dataset.target, camera, std::nullopt);
    return;
  }
  if (no_plan_) {
    pose_->setText(core_text(no_plan_->message));
    sketch_->setPose(dataset.target, camera, std::nullopt);
    return;
  }
  // Nothing is known yet: the plainest pose, seen by both for sure.
  BoardGridOptions plain;
  plain.distances_m = {2.0, 1.5, 3.0, 1.0, 4.0};
  plain.tilts_deg = {0.0};
  plain.rolls_deg = {0.0};
  plain.cells = 1;
  const auto poses = board_grid(dataset.target, camera, plain);
  pose_->setText(tr("Next: the whole board in view of both, two metres ahead"));
  sketch_->setPose(dataset.target, camera,
                   poses.empty() ? std::nullopt : std::optional(poses.front().camera_from_board));
}

void WatchWindow::showFullScreenWanted(bool full) {
  setWindowState(full ? windowState() | Qt::WindowFullScreen
                      : windowState() & ~Qt::WindowFullScreen);
}

void WatchWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && full_->isChecked()) {
    full_->setChecked(false);
    return;
  }
  QWidget::keyPressEvent(event);
}

void WatchWindow::retranslate() {
  setWindowTitle(tr("What next"));
  full_->setText(tr("&Full screen"));
  full_->setToolTip(tr("Larger, to be read from farther away (F11)"));
  stop_->setText(tr("&Stop watching"));
  sketch_->setTopWord(tr("top"));
  sketch_->setToolTip(
      tr("Where the board is to be in the camera's picture, its upper edge marked"));
  full_->setShortcut(Qt::Key_F11);
  showAll();
}

}  // namespace lvcalib::widgets

#include "moc_watch_window.cpp"
