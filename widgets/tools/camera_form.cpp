// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/camera_form.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>

#include "base/units.h"
#include "camera/camera_text.h"
#include "style/texts.h"
#include "tools/camera_preview.h"
#include "tools/key_form.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

const QStringList kMatrixKeys = {QStringLiteral("fx"), QStringLiteral("fy"), QStringLiteral("cx"),
                                 QStringLiteral("cy")};
constexpr DistortionModel kModels[] = {DistortionModel::kPlumbBob,
                                       DistortionModel::kRationalPolynomial,
                                       DistortionModel::kEquidistant};

QStringList coefficients_of(DistortionModel model) {
  const char* const names = model == DistortionModel::kPlumbBob ? "k1 k2 p1 p2 k3"
                            : model == DistortionModel::kRationalPolynomial
                                ? "k1 k2 p1 p2 k3 k4 k5 k6"
                                : "k1 k2 k3 k4";
  return QString::fromLatin1(names).split(QLatin1Char(' '));
}

QString exact_text(double value) {
  return QString::number(value, 'g', 15);
}

}  // namespace

CameraForm::CameraForm(QWidget* parent)
    : QWidget(parent),
      model_label_(new QLabel(this)),
      model_(new QComboBox(this)),
      form_(new KeyForm(this)),
      problem_(new QLabel(this)),
      preview_(new CameraPreview(this)),
      view_(new QLabel(this)) {
  setObjectName(QStringLiteral("camera_form"));
  model_->setObjectName(QStringLiteral("distortion_model"));
  problem_->setObjectName(QStringLiteral("camera_problem"));
  view_->setObjectName(QStringLiteral("camera_view"));
  const auto add = [this](const char* name, FormKey::Kind kind, const char* unit, bool sigma) {
    FormKey key;
    key.name = name;
    key.kind = kind;
    key.unit = unit;
    key.sigma = sigma;
    form_->add(key);
  };
  for (const char* key : {"image_width", "image_height"})
    add(key, FormKey::Kind::kNumber, "px", false);
  for (const char* key : {"fx", "fy", "cx", "cy"}) add(key, FormKey::Kind::kNumber, "px", true);
  for (const char* key : {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"})
    add(key, FormKey::Kind::kNumber, "", true);
  add("camera_name", FormKey::Kind::kWord, "", false);
  for (const DistortionModel model : kModels) model_->addItem(QString(), static_cast<int>(model));

  lay_out_form({model_label_, model_, form_, problem_, preview_, view_}, *this);
  connect(model_, &QComboBox::currentIndexChanged, this, &CameraForm::chooseModel);
  connect(form_, &KeyForm::edited, this, &CameraForm::check);
  follow_language(this, [this] { retranslate(); });
  chooseModel();
}

void CameraForm::setCamera(const Camera& camera,
                           const std::optional<CameraDeviations>& deviations) {
  {
    const QSignalBlocker a(model_), b(form_);
    model_->setCurrentIndex(std::max(0, model_->findData(static_cast<int>(camera.model))));
    form_->setValue(QStringLiteral("image_width"), QString::number(camera.width_px));
    form_->setValue(QStringLiteral("image_height"), QString::number(camera.height_px));
    form_->setValue(QStringLiteral("camera_name"), QString::fromStdString(camera.name));
    const auto sigma_text = [&](Eigen::Index k) {
      return deviations && (*deviations)(k) >= 0.0 ? QString::number((*deviations)(k), 'g', 6)
                                                   : QString();
    };
    const double values[] = {camera.fx, camera.fy, camera.cx, camera.cy};
    for (int k = 0; k < 4; ++k) {
      form_->setValue(kMatrixKeys[k], exact_text(values[k]));
      form_->setSigma(kMatrixKeys[k], sigma_text(k));
    }
    const QStringList names = coefficients();
    for (int k = 0; k < names.size(); ++k) {
      form_->setValue(names[k], exact_text(camera.distortion[k]));
      form_->setSigma(names[k], sigma_text(4 + k));
    }
  }
  chooseModel();
}

QStringList CameraForm::coefficients() const {
  return coefficients_of(static_cast<DistortionModel>(model_->currentData().toInt()));
}

std::string CameraForm::text() const {
  QString out;
  for (const char* key : {"image_width", "image_height", "camera_name"}) {
    const QString value = form_->value(QLatin1String(key));
    if (!value.isEmpty()) out += QStringLiteral("%1: %2\n").arg(QLatin1String(key), value);
  }
  const auto number = [&](const QString& key) {
    const QString value = form_->value(key);
    return value.isEmpty() ? QStringLiteral("0") : value;
  };
  out += QStringLiteral(
             "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [%1, 0, %2, 0, %3, %4, 0, 0, "
             "1]\n")
             .arg(number(kMatrixKeys[0]), number(kMatrixKeys[2]), number(kMatrixKeys[1]),
                  number(kMatrixKeys[3]));
  const auto model = static_cast<DistortionModel>(model_->currentData().toInt());
  const QStringList names = coefficients();
  QStringList values, distortion_sigmas, sigmas;
  for (const QString& name : names) values << number(name);
  out += QStringLiteral(
             "distortion_model: %1\ndistortion_coefficients:\n  rows: 1\n  cols: %2\n  "
             "data: [%3]\n")
             .arg(QString::fromStdString(name_of(model)))
             .arg(names.size())
             .arg(values.join(QStringLiteral(", ")));
  for (const QString& key : kMatrixKeys) {
    if (!form_->sigma(key).isEmpty())
      sigmas << QStringLiteral("%1: %2").arg(key, form_->sigma(key));
  }
  // A list has no gaps: what follows the first coefficient without one is not stated.
  for (const QString& name : names) {
    if (form_->sigma(name).isEmpty()) break;
    distortion_sigmas << form_->sigma(name);
  }
  if (!distortion_sigmas.isEmpty())
    sigmas << QStringLiteral("distortion: [%1]").arg(distortion_sigmas.join(QStringLiteral(", ")));
  if (!sigmas.isEmpty())
    out += QStringLiteral("standard_deviations: {%1}\n").arg(sigmas.join(QStringLiteral(", ")));
  return out.toStdString();
}

void CameraForm::chooseModel() {
  form_->showKeys(QStringList{QStringLiteral("image_width"), QStringLiteral("image_height"),
                              QStringLiteral("camera_name")} +
                  kMatrixKeys + coefficients());
  check();
}

void CameraForm::check() {
  form_->clearComplaints();
  camera_.reset();
  QString problem;
  const QStringList wrong = form_->notNumbers();
  for (const QString& key : wrong) form_->complain(key, tr("a number is expected here"));
  if (wrong.isEmpty()) {
    const auto file = camera_from_text(text(), "camera.yaml");
    std::optional<Error> error;
    if (!file) {
      error = file.error();
    } else {
      const auto deviations = camera_deviations_from_text(text(), "camera.yaml", file->camera);
      if (!deviations) error = deviations.error();
    }
    if (error) {
      error->where.clear();  // The line of a text that nobody sees helps nobody.
      const QString key = form_->keyNamedIn(*error);
      problem = core_text(*error);
      if (!key.isEmpty()) {
        form_->complain(key, problem);
        problem.clear();
      }
    } else {
      camera_ = file->camera;
      if (!file->warnings.empty()) problem = core_text(file->warnings.front());
    }
  }
  problem_->setText(problem.isEmpty() ? QString() : QStringLiteral("▲ ") + problem);
  problem_->setVisible(!problem.isEmpty());
  preview_->setCamera(camera_);
  const auto view = camera_ ? field_of_view(*camera_) : std::nullopt;
  view_->setText(view ? tr("Field of view: %1° × %2°")
                            .arg(QString::number(view->x() * kDegPerRad, 'f', 1),
                                 QString::number(view->y() * kDegPerRad, 'f', 1))
                      : QString());
  Q_EMIT edited();
}

void CameraForm::retranslate() {
  model_label_->setText(tr("&Distortion:"));
  const QString names[] = {tr("plumb_bob: radial and tangential"),
                           tr("rational_polynomial: wide angles"), tr("equidistant: fisheye")};
  for (int i = 0; i < 3; ++i) model_->setItemText(i, names[i]);
  preview_->setAccessibleName(tr("What the lens makes of straight lines"));
  const auto label = [this](const char* key, const QString& text, const QString& tip) {
    form_->setLabel(QLatin1String(key), text, tip);
  };
  label("image_width", tr("Image width"), tr("Of the images as they are given to the calibration"));
  label("image_height", tr("Image height"),
        tr("Of the images as they are given to the calibration"));
  label("camera_name", tr("Name"), tr("May stay blank"));
  label("fx", tr("Focal length, horizontal"),
        tr("In pixels; behind ± its standard deviation, blank: not stated"));
  label("fy", tr("Focal length, vertical"),
        tr("In pixels; behind ± its standard deviation, blank: not stated"));
  label("cx", tr("Principal point, right"),
        tr("From the centre of the top left pixel; behind ± its standard deviation"));
  label("cy", tr("Principal point, down"),
        tr("From the centre of the top left pixel; behind ± its standard deviation"));
  for (const char* key : {"k1", "k2", "k3", "k4", "k5", "k6"})
    label(key, tr("Radial %1").arg(QLatin1String(key)), tr("A coefficient of the distortion"));
  for (const char* key : {"p1", "p2"})
    label(key, tr("Tangential %1").arg(QLatin1String(key)), tr("A coefficient of the distortion"));
  check();
}

}  // namespace lvcalib::widgets

#include "moc_camera_form.cpp"
