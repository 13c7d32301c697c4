// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/check_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFileInfo>
#include <QGridLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "runner/scene_data.h"
#include "style/swatch.h"
#include "style/texts.h"
#include "views/color_map.h"
#include "views/image_view.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// Sliders count in parts of their range.
constexpr int kSliderSteps = 1000;
// Fine: what a bumped rig is off by; coarse: whatever way the LiDAR is mounted.
constexpr double kFine_mm = 100.0;
constexpr double kFine_mrad = 50.0;
constexpr double kCoarse_mm = 2000.0;
constexpr double kCoarse_mrad = 3142.0;
// Edges that lie on one of the image, and that do not.
const QColor kMeets(0, 220, 90);
const QColor kAlone(255, 70, 60);

bool is_turn(int row) {
  return row < 3;
}

double metres_ahead(const EdgeLook* look) {
  if (look == nullptr || look->points.empty()) return 3.0;
  std::vector<double> ranges;
  for (const EdgeLook::Point& p : look->points) ranges.push_back(p.range_m);
  std::nth_element(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2),
                   ranges.end());
  return ranges[ranges.size() / 2];
}

}  // namespace

CheckDialog::CheckDialog(CheckStart start, Choices& choices, QWidget* parent)
    : QDialog(parent),
      camera_(std::move(start.camera)),
      given_(std::move(start.pose)),
      pairs_(std::move(start.pairs)),
      has_guess_(start.has_guess),
      choices_(choices),
      folder_(std::move(start.folder)),
      place_label_(new QLabel(this)),
      place_(new QComboBox(this)),
      browse_(new QPushButton(this)),
      progress_(new QProgressBar(this)),
      cancel_(new QPushButton(this)),
      verdict_(new QLabel(this)),
      image_(new ImageView(this)),
      hint_(new QLabel(this)),
      points_(new QCheckBox(this)),
      edges_(new QCheckBox(this)),
      score_(new QLabel(this)),
      legend_(new QLabel(this)),
      group_(new QGroupBox(this)),
      range_label_(new QLabel(this)),
      range_(new QComboBox(this)),
      reset_(new QPushButton(this)),
      best_(new QPushButton(this)),
      take_(new QPushButton(this)),
      forget_(new QPushButton(this)),
      close_(new QPushButton(this)) {
  setObjectName(QStringLiteral("check_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  build();
  connectParts();
  setRange();
  follow_language(this, [this] { retranslate(); });
  if (!pairs_.empty()) work_.load(pairs_, camera_, given_.camera_from_lidar);
  showState();
}

CheckDialog::~CheckDialog() {
  work_.disconnect(this);
  // A box that loses the focus takes over what was typed into it.
  for (QDoubleSpinBox* box : boxes_) box->disconnect(this);
}

void CheckDialog::build() {
  resize(1180, 660);
  const std::pair<QWidget*, const char*> named[] = {
      {place_, "check_place"},   {browse_, "check_folder"}, {verdict_, "check_verdict"},
      {points_, "check_points"}, {edges_, "check_edges"},   {score_, "check_score"},
      {range_, "check_range"},   {reset_, "check_reset"},   {best_, "check_best"},
      {take_, "check_take"},     {forget_, "check_forget"}, {close_, "check_close"},
      {image_, "check_image"},   {legend_, "check_legend"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  for (QLabel* label : {verdict_, hint_, score_}) {
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
  }
  legend_->setWordWrap(true);
  legend_->setTextFormat(Qt::RichText);
  verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  // A line's worth of room, so that the picture stays where it is.
  verdict_->setMinimumHeight(2 * fontMetrics().lineSpacing());
  verdict_->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  QFont large = score_->font();
  large.setPointSizeF(1.6 * large.pointSizeF());
  score_->setFont(large);
  for (QPushButton* button : {browse_, cancel_, reset_, best_, take_, forget_, close_})
    button->setAutoDefault(false);
  place_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  place_->setMinimumContentsLength(18);
  place_label_->setBuddy(place_);
  range_label_->setBuddy(range_);
  points_->setChecked(true);
  edges_->setChecked(true);
  progress_->setRange(0, 1000);
  range_->addItems({QString(), QString()});
  range_->setCurrentIndex(given_.kind == CheckedPose::Kind::kNone ? 1 : 0);
  image_->setDragging(true);
  OverlayParts parts;
  parts.points = true;
  image_->overlay().setParts(parts);
  auto* head = new QHBoxLayout;
  head->addWidget(place_label_);
  head->addWidget(place_, 1);
  head->addWidget(browse_);
  head->addWidget(progress_, 1);
  head->addWidget(cancel_);
  auto* rows = new QGridLayout(group_);
  rows->addWidget(range_label_, 0, 0);
  rows->addWidget(range_, 0, 1, 1, 2);
  for (int k = 0; k < 6; ++k) {
    names_[k] = new QLabel(group_);
    sliders_[k] = new QSlider(Qt::Horizontal, group_);
    sliders_[k]->setRange(-kSliderSteps, kSliderSteps);
    boxes_[k] = new QDoubleSpinBox(group_);
    boxes_[k]->setObjectName(QStringLiteral("check_value_%1").arg(k));
    boxes_[k]->setDecimals(1);
    boxes_[k]->setKeyboardTracking(false);
    names_[k]->setBuddy(boxes_[k]);
    rows->addWidget(names_[k], k + 1, 0);
    rows->addWidget(sliders_[k], k + 1, 1);
    rows->addWidget(boxes_[k], k + 1, 2);
  }
  rows->setColumnStretch(1, 1);
  auto* side = new QWidget(this);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(score_);
  auto* shown = new QHBoxLayout;
  shown->addWidget(points_);
  shown->addWidget(edges_);
  shown->addStretch();
  column->addLayout(shown);
  column->addWidget(legend_);
  column->addWidget(group_);
  auto* grid = new QGridLayout;
  grid->addWidget(best_, 0, 0);
  grid->addWidget(reset_, 0, 1);
  grid->addWidget(take_, 1, 0);
  grid->addWidget(forget_, 1, 1);
  column->addLayout(grid);
  column->addWidget(hint_);
  column->addStretch();
  auto* foot = new QHBoxLayout;
  foot->addStretch();
  foot->addWidget(close_);
  column->addLayout(foot);
  auto* split = new QSplitter(Qt::Horizontal, this);
  split->addWidget(image_);
  split->addWidget(side);
  split->setChildrenCollapsible(false);
  split->setStretchFactor(0, 1);
  split->setSizes({800, 380});
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(head);
  layout->addWidget(verdict_);
  layout->addWidget(split, 1);
}

void CheckDialog::connectParts() {
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(cancel_, &QPushButton::clicked, this, [this] { work_.cancel(); });
  connect(browse_, &QPushButton::clicked, this,
          [this] { openFolder(choices_.files_to_import(this, folder_)); });
  connect(place_, &QComboBox::activated, this, &CheckDialog::showPlace);
  connect(points_, &QCheckBox::toggled, this, &CheckDialog::drawLook);
  connect(edges_, &QCheckBox::toggled, this, &CheckDialog::drawLook);
  connect(range_, &QComboBox::activated, this, &CheckDialog::setRange);
  for (int k = 0; k < 6; ++k) {
    connect(sliders_[k], &QSlider::sliderMoved, this, [this, k](int value) {
      boxes_[k]->setValue(boxes_[k]->maximum() * value / kSliderSteps);
    });
    connect(boxes_[k], &QDoubleSpinBox::valueChanged, this, [this, k](double value) {
      (is_turn(k) ? turn_(k) : shift_(k - 3)) = 1e-3 * value;
      const QSignalBlocker blocked(sliders_[k]);
      sliders_[k]->setValue(
          static_cast<int>(std::lround(value / boxes_[k]->maximum() * kSliderSteps)));
      moved_by_hand_ = true;
      look();
    });
  }
  connect(reset_, &QPushButton::clicked, this, [this] {
    setPose(given_.camera_from_lidar);
    moved_by_hand_ = false;
    showState();
  });
  connect(best_, &QPushButton::clicked, this, [this] {
    if (!places_) return;
    error_.reset();
    EdgeCheckOptions options;
    options.covariance = given_.covariance;
    // From where the hand has left it, which knows no errors.
    const bool given = !moved_by_hand_;
    if (!given) options.covariance.reset();
    work_.check(places_, pose(), options);
    showState();
  });
  connect(take_, &QPushButton::clicked, this, [this] {
    has_guess_ = true;
    Q_EMIT roughPoseWanted(pose());
    showState();
  });
  connect(forget_, &QPushButton::clicked, this, [this] {
    has_guess_ = false;
    Q_EMIT roughPoseWanted(std::nullopt);
    showState();
  });
  connect(image_, &ImageView::dragged, this, &CheckDialog::drag);
  connect(&work_, &EdgeWork::progressed, this, [this](double fraction, const QString& text) {
    progress_->setValue(static_cast<int>(1000.0 * fraction));
    progress_->setFormat(text);
  });
  connect(&work_, &EdgeWork::loaded, this, &CheckDialog::takeLoaded);
  connect(&work_, &EdgeWork::looked, this, [this](const std::shared_ptr<const EdgeLook>& look) {
    look_ = look;
    drawLook();
  });
  connect(&work_, &EdgeWork::checked, this, [this](const std::shared_ptr<const EdgeCheck>& check) {
    check_ = check;
    // What the calibration says is judged first; what was moved by hand goes where edges agree.
    if (moved_by_hand_) setPose(check->best_pose);
    showState();
  });
  connect(&work_, &EdgeWork::failed, this, [this](const Error& error) {
    error_ = error;
    showState();
  });
  connect(&work_, &EdgeWork::ended, this, &CheckDialog::showState);
}

void CheckDialog::openFolder(const QString& folder) {
  if (folder.isEmpty()) return;
  folder_ = folder;
  error_.reset();
  check_.reset();
  work_.load_folder(folder, camera_, given_.camera_from_lidar);
  showState();
}

void CheckDialog::takeLoaded(const std::shared_ptr<const EdgePlaces>& places) {
  places_ = places;
  place_->clear();
  for (const EdgeView& view : places_->read.views)
    place_->addItem(QString::fromStdString(view.name));
  place_->setCurrentIndex(0);
  showPlace();
  look();
  // The calibration is judged at once; there is nothing to judge in a guess.
  if (given_.kind == CheckedPose::Kind::kCalibration && !moved_by_hand_) {
    EdgeCheckOptions options;
    options.covariance = given_.covariance;
    work_.check(places_, given_.camera_from_lidar, options);
  }
  showState();
}

void CheckDialog::showPlace() {
  const int index = place_->currentIndex();
  if (!places_ || index < 0) return;
  const FilePair& pair = places_->pairs[places_->read.pairs[static_cast<std::size_t>(index)]];
  image_->setImage({});
  image_->overlay().setOverlay({});
  image_->setMessage(tr("The image is being loaded …"));
  loader_.start(
      [this, path = pair.image](const RunContext&, const Runner::Post&) -> Runner::Deliver {
        auto image = read_scene_image(path);
        return [this, image] {
          image_->setMessage(image ? QString()
                                   : tr("There is no image: %1").arg(core_text(image.error())));
          image_->setImage(image ? *image : QImage());
          image_->fit();
          drawLook();
        };
      });
  look();
}

Rigid3 CheckDialog::pose() const {
  return Rigid3{so3_exp(turn_), shift_} * given_.camera_from_lidar;
}

void CheckDialog::look() {
  if (!places_ || place_->currentIndex() < 0) return;
  work_.look(places_, static_cast<std::size_t>(place_->currentIndex()), pose());
  showState();
}

void CheckDialog::drawLook() {
  if (!look_) return;
  ImageOverlay overlay;
  std::vector<float> ranges;
  for (const EdgeLook::Point& p : look_->points) ranges.push_back(static_cast<float>(p.range_m));
  const ColorScale scale = scale_for(ranges, ColorMap::kSequential);
  if (points_->isChecked()) {
    for (const EdgeLook::Point& p : look_->points) {
      overlay.points.emplace_back(p.pixel.x(), p.pixel.y());
      overlay.point_colors.push_back(scale.color(p.range_m));
    }
  }
  if (edges_->isChecked()) {
    for (const ProjectedEdge& e : look_->edges) {
      overlay.points.emplace_back(e.pixel.x(), e.pixel.y());
      // Half of its full count: 1.2 widths off.
      overlay.point_colors.push_back((e.count > 0.5 ? kMeets : kAlone).rgb());
    }
  }
  image_->overlay().setOverlay(std::move(overlay));
  showLegend(scale);
  const EdgeScore& s = look_->score;
  score_->setText(
      s.edges == 0 ? tr("No edges in the picture")
                   : tr("Edge agreement %1 ± %2")
                         .arg(QString::number(s.score, 'f', 3), QString::number(s.sigma, 'f', 3)));
}

// What the colours of the dots mean, of those that are shown.
void CheckDialog::showLegend(const ColorScale& ranges) {
  const auto entry = [this](const QColor& color, const QString& text) {
    return QStringLiteral("%1&nbsp;%2")
        .arg(swatch_html(color, palette()), QString(text).replace(QLatin1Char(' '), QChar(0xa0)));
  };
  QStringList points;
  for (const double share : {0.0, 0.5, 1.0}) {
    const double range = ranges.low + share * (ranges.high - ranges.low);
    points << entry(QColor(ranges.color(range)), tr("%1 m").arg(range, 0, 'f', 1));
  }
  QStringList lines;
  if (points_->isChecked() && !look_->points.empty())
    lines << tr("Points:") + QLatin1Char(' ') + points.join(QLatin1Char(' '));
  if (edges_->isChecked() && !look_->edges.empty()) {
    lines << tr("Edges:") + QLatin1Char(' ') + entry(kMeets, tr("on an edge of the image")) +
                 QLatin1Char(' ') + entry(kAlone, tr("on none"));
  }
  legend_->setText(lines.join(QStringLiteral("<br>")));
}

// The swatches' edges are of the palette's.
void CheckDialog::changeEvent(QEvent* event) {
  QDialog::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) drawLook();
}

void CheckDialog::drag(const QPointF& from, const QPointF& to, Qt::KeyboardModifiers modifiers) {
  if (!places_) return;
  Rigid3 step;
  const Eigen::Vector2d a(from.x() - camera_.cx, from.y() - camera_.cy);
  const Eigen::Vector2d b(to.x() - camera_.cx, to.y() - camera_.cy);
  if (modifiers.testFlag(Qt::ShiftModifier)) {
    // About the optical axis, as the line from the middle of the picture to the cursor turns.
    const double turn = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    step.rotation = so3_exp(Eigen::Vector3d(0.0, 0.0, turn));
  } else if (modifiers.testFlag(Qt::ControlModifier)) {
    const double depth = metres_ahead(look_.get());
    step.translation = {depth * (b - a).x() / camera_.fx, depth * (b - a).y() / camera_.fy, 0.0};
  } else {
    // So that what is ahead follows the cursor.
    step.rotation =
        so3_exp(Eigen::Vector3d(-(b - a).y() / camera_.fy, (b - a).x() / camera_.fx, 0.0));
  }
  moved_by_hand_ = true;
  setPose(step * pose());
}

void CheckDialog::setPose(const Rigid3& pose) {
  const Rigid3 offset = pose * given_.camera_from_lidar.inverse();
  turn_ = so3_log(offset.rotation);
  shift_ = offset.translation;
  const double most_turn = 1e3 * turn_.cwiseAbs().maxCoeff();
  const double most_shift = 1e3 * shift_.cwiseAbs().maxCoeff();
  if (most_turn > kFine_mrad || most_shift > kFine_mm) range_->setCurrentIndex(1);
  setRange();
  look();
}

void CheckDialog::setRange() {
  const bool fine = range_->currentIndex() == 0;
  for (int k = 0; k < 6; ++k) {
    const double most =
        is_turn(k) ? (fine ? kFine_mrad : kCoarse_mrad) : (fine ? kFine_mm : kCoarse_mm);
    const double value = 1e3 * (is_turn(k) ? turn_(k) : shift_(k - 3));
    const QSignalBlocker box(boxes_[k]);
    const QSignalBlocker slider(sliders_[k]);
    // Never clip what is there.
    boxes_[k]->setRange(-std::max(most, std::abs(value)), std::max(most, std::abs(value)));
    boxes_[k]->setSingleStep(fine ? 0.5 : 10.0);
    boxes_[k]->setValue(value);
    sliders_[k]->setValue(
        static_cast<int>(std::lround(value / boxes_[k]->maximum() * kSliderSteps)));
  }
}

QString CheckDialog::checkText(const EdgeCheck& check) const {
  const auto number = [](double value) { return QString::number(value, 'g', 2); };
  // Both to the same decimal.
  const auto pixels = [](double value) { return QString::number(value, 'f', 1); };
  switch (check.verdict) {
    case EdgeVerdict::kAgrees:
      return tr("Edges agree with the calibration, to %1 ± %2 px. A turn by %3, %4 or %5 mrad "
                "about "
                "the camera's x, y, z would have been noticed.")
          .arg(pixels(check.offset_px), pixels(check.offset_sigma_px),
               number(1e3 * check.noticed_turn_rad.x()), number(1e3 * check.noticed_turn_rad.y()),
               number(1e3 * check.noticed_turn_rad.z()));
    case EdgeVerdict::kContradicts:
      return tr("Edges contradict the calibration: they agree better after a turn by %1 mrad and a "
                "shift by %2 mm, and are %3 ± %4 px off.")
          .arg(number(1e3 * check.offset.tail<3>().norm()),
               number(1e3 * check.offset.head<3>().norm()), pixels(check.offset_px),
               pixels(check.offset_sigma_px));
    case EdgeVerdict::kNoMeeting:
      return tr(
          "Cannot tell: edges of LiDAR and image meet no better than by chance, here and "
          "nearby. The pose is wrong by more than what is searched, or the two do not show "
          "the same. Move it by hand until they meet.");
    case EdgeVerdict::kUncertain:
      return tr("Cannot tell: where the edges agree is known to %1 px only. Take a place with more "
                "edges, near and far and all over the picture.")
          .arg(number(check.offset_sigma_px));
    default:
      return tr("Cannot tell: %1 edges of the LiDAR are in %2 parts of the picture; %3 in %4 are "
                "needed.")
          .arg(check.given.edges)
          .arg(check.parts)
          .arg(kLeastEdges)
          .arg(kLeastEdgeParts);
  }
}

QString CheckDialog::stateText() const {
  if (error_) return core_text(*error_);
  if (work_.busy()) return places_ ? tr("Edges are being compared …") : tr("Being read …");
  if (!places_)
    return tr(
        "Choose a folder of images and clouds that were taken together, with or without a "
        "board.");
  QStringList lines;
  if (check_ && !moved_by_hand_) {
    lines << checkText(*check_);
  } else if (given_.kind == CheckedPose::Kind::kNone) {
    lines << tr("There is no pose yet: drag the points until they lie on what they show.");
  } else {
    lines << tr("Moved by hand. Back to the start to have it judged.");
  }
  if (!places_->read.warnings.empty())
    lines << tr("%n pairs were left out; the first: %1", nullptr,
                static_cast<int>(places_->read.warnings.size()))
                 .arg(core_text(places_->read.warnings.front()));
  for (const Message& warning : places_->read.cloud_warnings)
    lines << core_text(warning) + QLatin1Char('.');
  return lines.join(QLatin1Char(' '));
}

void CheckDialog::showState() {
  verdict_->setText(stateText());
  const bool busy = work_.busy();
  progress_->setVisible(busy);
  cancel_->setVisible(busy);
  group_->setEnabled(places_ != nullptr);
  best_->setEnabled(places_ != nullptr && !busy);
  take_->setEnabled(places_ != nullptr);
  forget_->setEnabled(has_guess_);
}

void CheckDialog::retranslate() {
  setWindowTitle(tr("Check on fresh data"));
  place_label_->setText(tr("&Place"));
  browse_->setText(tr("&Folder…"));
  browse_->setToolTip(tr("A folder of images and clouds that were taken together, or a dataset"));
  cancel_->setText(tr("Cancel"));
  points_->setText(tr("Points"));
  points_->setToolTip(tr("The LiDAR's points under this pose, coloured by distance"));
  edges_->setText(tr("Edges"));
  edges_->setToolTip(
      tr("The LiDAR's edges: green where they lie on one of the image, red where not"));
  score_->setToolTip(
      tr("The share of the LiDAR's edges that lie on one of the image, above what chance gives: 0 "
         "chance, 1 all. Of all places together."));
  group_->setTitle(given_.kind == CheckedPose::Kind::kCalibration ? tr("Against the calibration")
                   : given_.kind == CheckedPose::Kind::kRough     ? tr("Against the rough pose")
                                                                  : tr("Against a LiDAR that looks "
                                                                           "ahead"));
  range_label_->setText(tr("&Range"));
  range_->setItemText(0, tr("fine: 50 mrad, 100 mm"));
  range_->setItemText(1, tr("coarse: 180°, 2 m"));
  const QString names[] = {tr("Turn x, mrad"), tr("Turn y, mrad"), tr("Turn z, mrad"),
                           tr("Shift x, mm"),  tr("Shift y, mm"),  tr("Shift z, mm")};
  for (int k = 0; k < 6; ++k) {
    names_[k]->setText(names[k]);
    sliders_[k]->setAccessibleName(names[k]);
    boxes_[k]->setToolTip(is_turn(k) ? tr("About an axis of the camera: x right, y down, z ahead")
                                     : tr("Along an axis of the camera: x right, y down, z ahead"));
  }
  best_->setText(tr("To where edges &agree"));
  best_->setToolTip(tr("From this pose to the one nearby where most edges agree"));
  reset_->setText(tr("&Back to the start"));
  take_->setText(tr("Take as &rough pose"));
  take_->setToolTip(tr("The board is then looked for about where this pose has it; can be undone"));
  forget_->setText(tr("&No rough pose"));
  hint_->setText(
      tr("Drag in the picture: the points follow. With Shift they turn about the middle, with Ctrl "
         "they shift. The wheel zooms."));
  close_->setText(tr("Close"));
  drawLook();
  showState();
}

}  // namespace lvcalib::widgets

#include "moc_check_dialog.cpp"
