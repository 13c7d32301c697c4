// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/target_form.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QTimer>
#include <algorithm>

#include "base/yaml_file.h"
#include "style/texts.h"
#include "target/sheet.h"
#include "target/target_text.h"
#include "tools/key_form.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// A board is drawn for the screen with so many pixels along its longer side.
constexpr double kPreviewPx = 900.0;
constexpr int kSettleMs = 150;

// Keys of target.yaml that hold a pair have one field for each of both.
const QString kOffsetX = QStringLiteral("boardOffset x");
const QString kOffsetY = QStringLiteral("boardOffset y");

QStringList dictionaries() {
  QStringList out;
  for (const std::string& name : marker_dictionaries()) out << QString::fromStdString(name);
  return out;
}

FormKey number_key(const char* name) {
  FormKey out;
  out.name = name;
  return out;
}

FormKey length_key(const char* name) {
  FormKey out = number_key(name);
  out.factor = 1e3;
  out.unit = "mm";
  return out;
}

FormKey word_key(const char* name, const QStringList& words) {
  FormKey out = number_key(name);
  out.kind = FormKey::Kind::kWord;
  out.words = words;
  return out;
}

FormKey flag_key(const char* name) {
  FormKey out = number_key(name);
  out.kind = FormKey::Kind::kFlag;
  return out;
}

std::vector<FormKey> all_keys() {
  const QStringList families = {QStringLiteral("tag36h11"), QStringLiteral("tag36h10"),
                                QStringLiteral("tag25h9"), QStringLiteral("tag16h5")};
  return {word_key("tagFamily", families),
          word_key("dictionary", dictionaries()),
          number_key("tagCols"),
          number_key("tagRows"),
          number_key("targetCols"),
          number_key("targetRows"),
          number_key("tagId"),
          length_key("tagSize"),
          number_key("tagSpacing"),
          length_key("squareSize"),
          length_key("colSpacingMeters"),
          length_key("rowSpacingMeters"),
          length_key("markerSize"),
          number_key("tagBorder"),
          number_key("firstTagId"),
          number_key("firstMarkerId"),
          flag_key("legacyPattern"),
          length_key("circleRadius"),
          length_key("margin"),
          length_key("boardWidth"),
          length_key("boardHeight"),
          length_key("boardOffset x"),
          length_key("boardOffset y"),
          length_key("measuredLength"),
          length_key("drawnLength"),
          length_key("measuredSigma")};
}

// The keys of a type, in the order of the file.
QStringList keys_of(const QString& type) {
  static const std::map<QString, QString> own = {
      {QStringLiteral("aprilgrid_circles"),
       QStringLiteral("tagFamily,tagCols,tagRows,tagSize,tagSpacing,tagBorder,firstTagId,"
                      "circleRadius,margin")},
      {QStringLiteral("aprilgrid"),
       QStringLiteral("tagFamily,tagCols,tagRows,tagSize,tagSpacing,tagBorder,firstTagId,margin")},
      {QStringLiteral("checkerboard"),
       QStringLiteral("targetCols,targetRows,colSpacingMeters,rowSpacingMeters,boardWidth,"
                      "boardHeight,boardOffset x,boardOffset y")},
      {QStringLiteral("charuco"),
       QStringLiteral("targetCols,targetRows,squareSize,markerSize,dictionary,firstMarkerId,"
                      "legacyPattern,boardWidth,boardHeight,boardOffset x,boardOffset y")},
      {QStringLiteral("apriltag"),
       QStringLiteral("tagFamily,tagId,tagSize,tagBorder,boardWidth,boardHeight,boardOffset x,"
                      "boardOffset y")}};
  return (own.at(type) + QStringLiteral(",measuredLength,drawnLength,measuredSigma"))
      .split(QLatin1Char(','));
}

const QStringList& types() {
  static const QStringList all = {QStringLiteral("aprilgrid_circles"), QStringLiteral("aprilgrid"),
                                  QStringLiteral("checkerboard"), QStringLiteral("charuco"),
                                  QStringLiteral("apriltag")};
  return all;
}

// The board as printed, small enough for a screen; nothing if it cannot be drawn.
QImage picture_of(const Target& target, const RunContext& context) {
  const Eigen::Vector2d size_m = target.outline().size_m();
  SheetOptions options;
  options.dpi = std::clamp(kPreviewPx / (size_m.maxCoeff() / 0.0254), 1.0, 600.0);
  const auto sheet = draw_sheet(target, SheetFormat::kPng, options, context);
  if (!sheet) return {};
  return QImage::fromData(QByteArray::fromStdString(*sheet), "PNG");
}

}  // namespace

TargetForm::TargetForm(QWidget* parent)
    : QWidget(parent),
      type_label_(new QLabel(this)),
      type_(new QComboBox(this)),
      form_(new KeyForm(this)),
      problem_(new QLabel(this)),
      preview_(new QLabel(this)),
      size_(new QLabel(this)),
      settle_(new QTimer(this)) {
  setObjectName(QStringLiteral("target_form"));
  type_->setObjectName(QStringLiteral("target_type"));
  problem_->setObjectName(QStringLiteral("target_problem"));
  preview_->setObjectName(QStringLiteral("target_preview"));
  size_->setObjectName(QStringLiteral("target_size"));
  for (const FormKey& key : all_keys()) form_->add(key);
  preview_->setAlignment(Qt::AlignCenter);
  preview_->setMinimumSize(260, 220);
  // The picture follows the room that there is, not the other way round.
  preview_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  for (const QString& type : types()) type_->addItem(QString(), type);

  lay_out_form({type_label_, type_, form_, problem_, preview_, size_}, *this);

  settle_->setSingleShot(true);
  settle_->setInterval(kSettleMs);
  connect(settle_, &QTimer::timeout, this, &TargetForm::draw);
  connect(type_, &QComboBox::currentIndexChanged, this, &TargetForm::chooseType);
  connect(form_, &KeyForm::edited, this, &TargetForm::check);
  follow_language(this, [this] { retranslate(); });
  setText(to_yaml(Target{}));
}

TargetForm::~TargetForm() {
  runner_.disconnect(this);
}

void TargetForm::setText(const std::string& yaml) {
  const auto file = YamlFile::parse(yaml, "target.yaml");
  if (!file) return;
  const auto scalar = [&](const char* key) {
    const YamlValue* value = file->root().find(key);
    return value == nullptr ? QString() : QString::fromStdString(value->scalar);
  };
  {
    const QSignalBlocker a(type_), b(form_);
    type_->setCurrentIndex(std::max(0, type_->findData(scalar("target_type"))));
    for (const FormKey& key : all_keys())
      form_->setValue(QLatin1String(key.name), scalar(key.name));
    if (const auto pair = file->numbers("boardOffset", 2)) {
      form_->setValue(kOffsetX, QString::number((*pair)[0], 'g', 12));
      form_->setValue(kOffsetY, QString::number((*pair)[1], 'g', 12));
    }
  }
  chooseType();
}

std::string TargetForm::text() const {
  const QString type = type_->currentData().toString();
  QString out = QStringLiteral("target_type: %1\n").arg(type);
  for (const QString& key : keys_of(type)) {
    if (key == kOffsetX || key == kOffsetY) continue;
    const QString value = form_->value(key);
    if (!value.isEmpty()) out += QStringLiteral("%1: %2\n").arg(key, value);
  }
  if (keys_of(type).contains(kOffsetX)) {
    const auto part = [&](const QString& key) {
      const QString value = form_->value(key);
      return value.isEmpty() ? QStringLiteral("0") : value;
    };
    out += QStringLiteral("boardOffset: [%1, %2]\n").arg(part(kOffsetX), part(kOffsetY));
  }
  return out.toStdString();
}

void TargetForm::chooseType() {
  form_->showKeys(keys_of(type_->currentData().toString()));
  retranslate();  // Columns of tags, of squares, of corners.
  check();
}

void TargetForm::check() {
  form_->clearComplaints();
  const auto file = target_from_text(text(), "target.yaml");
  target_ = file ? std::optional(file->target) : std::nullopt;
  QString problem;
  if (!file) {
    const QString key = form_->keyNamedIn(file.error());
    // The line of a text that nobody sees helps nobody.
    Error error = file.error();
    error.where.clear();
    problem = core_text(error);
    if (!key.isEmpty()) {
      form_->complain(key, problem);
      problem.clear();
    }
  }
  problem_->setText(problem.isEmpty() ? QString() : QStringLiteral("▲ ") + problem);
  problem_->setVisible(!problem.isEmpty());
  settle_->start();
  Q_EMIT edited();
}

void TargetForm::draw() {
  if (!target_) {
    runner_.cancel();
    picture_ = {};
    size_->clear();
    showPicture();
    return;
  }
  runner_.start(
      [this, target = *target_](const RunContext& context, const Runner::Post&) -> Runner::Deliver {
        QImage image = picture_of(target, context);
        return [this, image = std::move(image)] {
          picture_ = QPixmap::fromImage(image);
          showPicture();
        };
      });
  const Eigen::Vector2d size_mm = 1e3 * target_->outline().size_m();
  size_->setText(
      tr("Board of %1 × %2 mm; tags or markers: %3, circles: %4, corners of squares: %5")
          .arg(QString::number(size_mm.x(), 'f', 1), QString::number(size_mm.y(), 'f', 1))
          .arg(target_->has_tags() ? target_->tag_count() : 0)
          .arg(target_->nodes().size())
          .arg(target_->checkerboard_corners_m().size()));
}

void TargetForm::showPicture() {
  preview_->setPixmap(picture_.isNull() ? picture_
                                        : picture_.scaled(preview_->size(), Qt::KeepAspectRatio,
                                                          Qt::SmoothTransformation));
}

void TargetForm::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  showPicture();
}

void TargetForm::retranslate() {
  type_label_->setText(tr("&Kind of board:"));
  const QString names[] = {tr("Tags with circles between them"), tr("AprilGrid"),
                           tr("Checkerboard"), tr("ChArUco"), tr("A single AprilTag")};
  for (int i = 0; i < types().size(); ++i) type_->setItemText(i, names[i]);
  preview_->setAccessibleName(tr("The board as it would be printed"));
  const bool corners = type_->currentData().toString() == QLatin1String("checkerboard");
  const auto label = [this](const QString& key, const QString& text, const QString& tip) {
    form_->setLabel(key, text, tip);
  };
  label(QStringLiteral("tagFamily"), tr("Tag family"), tr("Which set of AprilTags is printed"));
  label(QStringLiteral("dictionary"), tr("Dictionary"), tr("OpenCV's name of the set of markers"));
  label(QStringLiteral("tagCols"), tr("Tags in a row"), tr("Number of tags from left to right"));
  label(QStringLiteral("tagRows"), tr("Rows of tags"), tr("Number of tags from bottom to top"));
  label(QStringLiteral("targetCols"),
        corners ? tr("Inner corners in a row") : tr("Squares in a row"),
        tr("Counted along the rows; of a checkerboard the corners where four squares meet, of a "
           "ChArUco board the squares"));
  label(QStringLiteral("targetRows"), corners ? tr("Rows of inner corners") : tr("Rows of squares"),
        tr("Counted along the columns; of a checkerboard the corners where four squares meet, of a "
           "ChArUco board the squares"));
  label(QStringLiteral("tagId"), tr("Number of the tag"), tr("Its number in the family"));
  label(QStringLiteral("tagSize"), tr("Tag size"), tr("Outer edge of the tag's black border"));
  label(QStringLiteral("tagSpacing"), tr("Gap over tag size"),
        tr("White gap between two tags as a part of the tag size"));
  label(QStringLiteral("squareSize"), tr("Square size"), tr("Edge of a square"));
  label(QStringLiteral("colSpacingMeters"), tr("Square width"),
        tr("From one corner to the next in a row"));
  label(QStringLiteral("rowSpacingMeters"), tr("Square height"),
        tr("From one row of corners to the next"));
  label(QStringLiteral("markerSize"), tr("Marker size"), tr("Outer edge of a marker"));
  label(QStringLiteral("tagBorder"), tr("Black border, in bits"),
        tr("Width of the tag's black border: 1 as AprilTag draws it, 2 as Kalibr does"));
  label(QStringLiteral("firstTagId"), tr("First number"),
        tr("Number of the tag at the lower left; the others follow"));
  label(QStringLiteral("firstMarkerId"), tr("First number"),
        tr("Number of the marker at the upper left; the others follow"));
  label(QStringLiteral("legacyPattern"), tr("White square at the top left"),
        tr("Boards of OpenCV before 4.6 with an even number of rows begin with a white square"));
  label(QStringLiteral("circleRadius"), tr("Circle radius"),
        tr("Of the black circles between the tags"));
  label(QStringLiteral("margin"), tr("White margin"), tr("White border beyond the outer tags"));
  label(QStringLiteral("boardWidth"), tr("Board width"),
        tr("Of the plate that the print is glued to; blank: it ends with the print"));
  label(QStringLiteral("boardHeight"), tr("Board height"),
        tr("Of the plate that the print is glued to; blank: it ends with the print"));
  label(kOffsetX, tr("Print off centre, right"),
        tr("From the middle of the plate to the middle of the print, to the right"));
  label(kOffsetY, tr("Print off centre, up"),
        tr("From the middle of the plate to the middle of the print, upwards"));
  label(QStringLiteral("measuredLength"), tr("Measured length"),
        tr("Any length on the print as a rule tells it; blank: nobody measured"));
  label(QStringLiteral("drawnLength"), tr("The same as drawn"),
        tr("The length that was measured, as it was meant to be"));
  label(QStringLiteral("measuredSigma"), tr("Its standard deviation"),
        tr("How well the length was measured; blank: 0.5 mm, as a rule is read"));
  if (target_) settle_->start();
}

}  // namespace lvcalib::widgets

#include "moc_target_form.cpp"
