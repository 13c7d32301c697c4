// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/scene_model.h"

#include <QGuiApplication>
#include <QMimeData>
#include <QPalette>
#include <QRegularExpression>
#include <algorithm>
#include <tuple>

#include "pipeline/refusals.h"
#include "style/edits_text.h"
#include "style/theme.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

template <class T>
QVariant number_or_nothing(const std::optional<T>& value) {
  return value ? QVariant::fromValue(*value) : QVariant();
}

constexpr const char* kSceneNames = "application/x-lvcalib-scenes";

QVariant fixed(const std::optional<double>& value, int decimals) {
  return value ? QVariant(QString::number(*value, 'f', decimals)) : QVariant();
}

// A file of the scene by its name alone: where the scene lies would fill the little room there is.
QString without_folder(const QString& words, const QString& scene) {
  static const QRegularExpression kEndOfPlace(QStringLiteral("[:：]"));
  const qsizetype end = words.indexOf(kEndOfPlace);
  if (end < 0) return words;
  const QString folder = QLatin1Char('/') + scene + QLatin1Char('/');
  const qsizetype at = words.left(end).lastIndexOf(folder);
  return at < 0 ? words : words.mid(at + folder.size());
}

}  // namespace

SceneModel::SceneModel(QObject* parent) : QAbstractTableModel(parent) {}

void SceneModel::set_scenes(const Dataset& dataset, const QStringList& missing) {
  beginResetModel();
  rows_.clear();
  // Scenes of every rig are called A, B, C.
  if (dataset.path != dataset_) thumbnails_.clear();
  dataset_ = dataset.path;
  has_tags_ = dataset.target.has_tags();
  problems_.clear();
  for (const SceneFiles& files : dataset.scenes) {
    Row row;
    row.name = QString::fromStdString(files.name);
    rows_.push_back(row);
  }
  for (const QString& name : missing) {
    Row row;
    row.name = name;
    row.missing = true;
    rows_.push_back(row);
  }
  decisions_ = {};
  result_.reset();
  endResetModel();
}

void SceneModel::set_decisions(const Decisions& decisions) {
  decisions_ = decisions;
  put_in_order();
  refill();
}

// As the user has them; scenes that no order names follow by name, missing ones at the end.
void SceneModel::put_in_order() {
  const auto& order = decisions_.scene_order;
  const auto place = [&](const Row& row) {
    const auto found = std::find(order.begin(), order.end(), row.name.toStdString());
    return std::tuple(row.missing, found - order.begin(), row.name.toStdString());
  };
  const auto before = [&](const Row& a, const Row& b) { return place(a) < place(b); };
  if (std::is_sorted(rows_.begin(), rows_.end(), before)) return;
  Q_EMIT layoutAboutToBeChanged();
  QStringList names;
  for (const Row& row : rows_) names << row.name;
  std::stable_sort(rows_.begin(), rows_.end(), before);
  for (const QModelIndex& old : persistentIndexList())
    changePersistentIndex(old, index(row_of(names[old.row()]), old.column()));
  Q_EMIT layoutChanged();
}

void SceneModel::set_result(const std::shared_ptr<const CalibrationResult>& result) {
  result_ = result;
  refill();
}

void SceneModel::refill() {
  for (Row& old : rows_) {
    Row row;
    row.name = old.name;
    row.missing = old.missing;
    const SceneDecision decision = decision_of(decisions_, row.name.toStdString());
    row.use = decision.use;
    row.note = QString::fromStdString(decision.note);
    row.cropped = decision.crop.has_value();
    row.insisted = decision.insist;
    if (result_) fill_result(row, *result_);
    old = row;
  }
  if (!rows_.empty()) {
    Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, kColumns - 1));
  }
}

void SceneModel::fill_result(Row& row, const CalibrationResult& result) const {
  const std::string name = row.name.toStdString();
  for (const SceneResult& scene : result.scenes) {
    if (scene.name != name) continue;
    row.ran = scene.view || !scene.reason.empty();
    row.used = scene.used;
    row.can_be_insisted_on = lvcalib::can_be_insisted_on(scene);
    row.edited = edits_text(scene);
    row.refused = refusals_text(result, scene.name);
    for (const Refusal& refusal : refusals(result))
      row.refused_tags += refusal.scene == name && refusal.what == Refusal::What::kTag;
    row.objection = scene.objection;
    row.reason = scene.reason;
    row.rejected = scene.rejected;
    if (scene.view && result.target.has_tags()) row.tags = scene.view->tag_count;
    if (scene.refinement) row.points = static_cast<int>(scene.refinement->board_points);
  }
  for (const SceneSolution& solved : result.extrinsic.scenes) {
    // Also of one that is left out: how it fits what the others give.
    if (solved.name != name) continue;
    row.rms_px = solved.rms_px;
    row.rms_mm = solved.rms_mm;
  }
  for (const LeaveOneOut& without : result.extrinsic.leave_one_out) {
    if (without.without != name) continue;
    row.influence_mm = without.translation_mm;
    row.influence_mrad = without.rotation_mrad;
  }
}

void SceneModel::retranslate() {
  Q_EMIT headerDataChanged(Qt::Horizontal, 0, kColumns - 1);
  if (!rows_.empty()) Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, kColumns - 1));
}

void SceneModel::set_thumbnail(const QString& scene, const QImage& image) {
  thumbnails_[scene] = QPixmap::fromImage(image);
  const int row = row_of(scene);
  if (row >= 0) Q_EMIT dataChanged(index(row, kName), index(row, kName), {Qt::DecorationRole});
}

void SceneModel::set_thumbnail_width(int width_px) {
  if (width_px == thumbnail_width_) return;
  thumbnail_width_ = width_px;
  if (!rows_.empty())
    Q_EMIT dataChanged(index(0, kName), index(rowCount() - 1, kName), {Qt::DecorationRole});
}

void SceneModel::set_state_room(const QFontMetrics& metrics, int width_px) {
  if (metrics_ && *metrics_ == metrics && width_px == state_room_px_) return;
  QStringList before;
  for (const Row& row : rows_) before << state_said(row);
  metrics_ = metrics;
  state_room_px_ = width_px;
  QStringList after;
  for (const Row& row : rows_) after << state_said(row);
  if (before != after)
    Q_EMIT dataChanged(index(0, kState), index(rowCount() - 1, kState), {Qt::DisplayRole});
}

QStringList SceneModel::state_names() const {
  QStringList names;
  for (const Row& row : rows_) names << state_name(row);
  return names;
}

void SceneModel::set_problem(const QString& scene, const Message& problem) {
  if (problems_.value(scene) == problem) return;
  if (problem.empty()) {
    problems_.remove(scene);
  } else {
    problems_[scene] = problem;
  }
  const int row = row_of(scene);
  if (row >= 0) Q_EMIT dataChanged(index(row, 0), index(row, kColumns - 1));
}

int SceneModel::row_of(const QString& scene) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == scene; });
  return found == rows_.end() ? -1 : static_cast<int>(found - rows_.begin());
}

QString SceneModel::scene_at(int row) const {
  return row < 0 || row >= rowCount() ? QString() : rows_[static_cast<std::size_t>(row)].name;
}

bool SceneModel::is_missing(int row) const {
  return row >= 0 && row < rowCount() && rows_[static_cast<std::size_t>(row)].missing;
}

bool SceneModel::can_be_insisted_on(int row) const {
  return row >= 0 && row < rowCount() && rows_[static_cast<std::size_t>(row)].use &&
         rows_[static_cast<std::size_t>(row)].can_be_insisted_on;
}

bool SceneModel::is_insisted_on(int row) const {
  return row >= 0 && row < rowCount() && rows_[static_cast<std::size_t>(row)].insisted;
}

int SceneModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int SceneModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(kColumns);
}

QVariant SceneModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = rows_[static_cast<std::size_t>(index.row())];
  switch (role) {
    case Qt::DisplayRole:
      return index.column() == kState ? QVariant(state_said(row)) : text(row, index.column());
    case Qt::AccessibleTextRole:
      return index.column() == kState ? QVariant(state_words(row)) : QVariant();
    case kSortRole:
      return number(row, index.column());
    case Qt::ToolTipRole:
      return tool_tip(row, index.column());
    case Qt::CheckStateRole:
      if (index.column() == kName && !row.missing) return row.use ? Qt::Checked : Qt::Unchecked;
      return {};
    case Qt::DecorationRole:
      if (index.column() == kState) {
        // A pixmap keeps its size; an icon would take that of the thumbnails.
        return mark_icon(mark_of(row), QGuiApplication::palette())
            .pixmap(QSize(16, 16), qApp->devicePixelRatio());
      }
      if (index.column() == kName && thumbnail_width_ > 0) {
        const QPixmap picture = thumbnails_.value(row.name);
        if (picture.width() <= thumbnail_width_) return picture;
        return picture.scaledToWidth(thumbnail_width_, Qt::SmoothTransformation);
      }
      return {};
    case Qt::ForegroundRole:
      if (index.column() == kState && mark_of(row) == Mark::kBad)
        return state_colors(QGuiApplication::palette()).bad;
      if (!row.used && (index.column() == kPixels || index.column() == kMillimetres))
        return QGuiApplication::palette().color(QPalette::Disabled, QPalette::Text);
      return {};
    case Qt::EditRole:
      return index.column() == kNote ? QVariant(row.note) : QVariant();
    case Qt::TextAlignmentRole:
      if (index.column() != kName && index.column() != kState && index.column() != kNote)
        return QVariant(Qt::AlignRight | Qt::AlignVCenter);
      return {};
    default:
      return {};
  }
}

QVariant SceneModel::text(const Row& row, int column) const {
  switch (column) {
    case kName:
      return row.name;
    case kTags:
      if (!row.tags) return {};
      if (row.refused_tags == 0) return QString::number(*row.tags);
      return tr("%1/%2").arg(std::max(0, *row.tags - row.refused_tags)).arg(*row.tags);
    case kPoints:
      return row.points ? QVariant(QString::number(*row.points)) : QVariant();
    case kPixels:
      return fixed(row.rms_px, 3);
    case kMillimetres:
      return fixed(row.rms_mm, 2);
    case kInfluence:
      return fixed(row.influence_mm, 2);
    case kState:
      return without_folder(state_words(row), row.name);
    case kNote:
      return row.note;
    default:
      return {};
  }
}

QVariant SceneModel::number(const Row& row, int column) const {
  switch (column) {
    case kTags:
      return number_or_nothing(row.tags);
    case kPoints:
      return number_or_nothing(row.points);
    case kPixels:
      return number_or_nothing(row.rms_px);
    case kMillimetres:
      return number_or_nothing(row.rms_mm);
    case kInfluence:
      return number_or_nothing(row.influence_mm);
    default:
      return text(row, column);
  }
}

QString SceneModel::state_words(const Row& row) const {
  if (row.missing) return tr("missing on disk");
  if (!row.use) return tr("rejected");
  // What a run says counts; before it, and for a scene that it has not seen, what loading says.
  if (!row.ran && problems_.contains(row.name)) return core_text(problems_.value(row.name));
  if (!row.ran) return tr("not run");
  const QString crop = row.cropped ? tr(" (cropped)") : QString();
  if (row.used && !row.objection.empty())
    return tr("used all the same: %1").arg(core_text(row.objection)) + crop;
  if (row.used) return tr("used") + crop;
  // A scene just taken back in still has the reason of the last run.
  if (row.reason.empty() || row.rejected) return tr("to be run") + crop;
  return core_text(row.reason) + crop;
}

// The same by a word, as the list has room for no more beside its figures.
QString SceneModel::state_name(const Row& row) const {
  if (row.missing) return tr("missing");
  if (!row.use) return tr("rejected");
  if (!row.ran) return problems_.contains(row.name) ? tr("unreadable") : tr("not run");
  if (row.used) return tr("used");
  return row.reason.empty() || row.rejected ? tr("to be run") : tr("refused");
}

QString SceneModel::state_said(const Row& row) const {
  const QString words = text(row, kState).toString();
  const auto fits = [this](const QString& said) {
    return !metrics_ || metrics_->horizontalAdvance(said) <= state_room_px_;
  };
  if (fits(words)) return words;
  const QString name = state_name(row);
  return fits(name) ? name : QString();
}

Mark SceneModel::mark_of(const Row& row) const {
  if (row.missing) return Mark::kMissing;
  if (!row.use) return Mark::kLeftOut;
  if (!row.ran && problems_.contains(row.name)) return Mark::kBad;
  if (!row.ran || row.rejected) return Mark::kIdle;
  if (row.used && !row.objection.empty()) return Mark::kDoubtful;
  return row.used ? Mark::kGood : Mark::kBad;
}

QString SceneModel::tool_tip(const Row& row, int column) const {
  switch (column) {
    case kName:
      return tr("Scene %1. Ticked: it takes part in the calibration.").arg(row.name);
    case kInfluence:
      if (!row.influence_mm) break;
      return tr("Without this scene the result moves by %1 mm and %2 mrad.")
          .arg(*row.influence_mm, 0, 'f', 3)
          .arg(*row.influence_mrad, 0, 'f', 3);
    case kPixels:
    case kMillimetres:
      if (row.used || !row.rms_px) break;
      return tr("Left out: how it fits what the other scenes give.");
    case kState:
      return QStringList({state_words(row), row.edited, row.refused})
          .join(QLatin1Char('\n'))
          .trimmed();
    case kTags:
    case kPoints:
      if (row.refused.isEmpty()) break;
      return headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString() + QLatin1Char('\n') +
             row.refused;
    case kNote:
      if (row.note.isEmpty()) break;
      return row.note;
    default:
      break;
  }
  return headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString();
}

QVariant SceneModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  struct Header {
    QString text, tip;
  };
  const auto header = [&]() -> Header {
    switch (section) {
      case kName:
        return {tr("Scene"), tr("Ticked scenes take part in the calibration.")};
      case kTags:
        return {tr("Tags"), tr("Tags found in the image; 13/16: the program uses 13 of 16.")};
      case kPoints:
        return {tr("Points"), tr("LiDAR points on the board.")};
      case kPixels:
        return {tr("px"), tr("Root mean square of the tag corners' reprojection errors, px.")};
      case kMillimetres:
        return {tr("mm"), tr("Root mean square distance of LiDAR nodes to the board's, mm.")};
      case kInfluence:
        return {tr("Infl."), tr("Influence: how far the result moves without this scene, mm.")};
      case kNote:
        return {tr("Note"), tr("Your own words about the scene; kept in the project.")};
      default:
        return {tr("State"), tr("Whether the scene is used, and why not.")};
    }
  }();
  if (role == Qt::DisplayRole) return header.text;
  if (role == Qt::ToolTipRole) return header.tip;
  return {};
}

Qt::ItemFlags SceneModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return Qt::ItemIsDropEnabled;  // Between rows, not on them.
  Qt::ItemFlags flags = Qt::ItemIsSelectable | Qt::ItemIsEnabled | Qt::ItemIsDragEnabled;
  if (index.column() == kNote && !is_missing(index.row())) flags |= Qt::ItemIsEditable;
  if (index.column() == kName && !is_missing(index.row())) flags |= Qt::ItemIsUserCheckable;
  return flags;
}

bool SceneModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role == Qt::EditRole && index.column() == kNote && !is_missing(index.row())) {
    Q_EMIT note_wanted(scene_at(index.row()), value.toString().trimmed());
    return true;
  }
  if (role != Qt::CheckStateRole || index.column() != kName || is_missing(index.row()))
    return false;
  Q_EMIT use_wanted(scene_at(index.row()), value.toInt() == Qt::Checked);
  return true;
}

bool SceneModel::has_notes() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [](const Row& row) { return !row.note.isEmpty(); });
}

QStringList SceneModel::mimeTypes() const {
  return {QString::fromLatin1(kSceneNames)};
}

QMimeData* SceneModel::mimeData(const QModelIndexList& indexes) const {
  QStringList names;
  for (const QModelIndex& index : indexes) {
    const QString name = scene_at(index.row());
    if (!names.contains(name)) names << name;
  }
  auto* data = new QMimeData;
  data->setData(QString::fromLatin1(kSceneNames), names.join(QLatin1Char('\n')).toUtf8());
  return data;
}

bool SceneModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int /*column*/,
                              const QModelIndex& parent) {
  if (action != Qt::MoveAction || !data->hasFormat(QString::fromLatin1(kSceneNames))) return false;
  const QStringList names =
      QString::fromUtf8(data->data(QString::fromLatin1(kSceneNames))).split(QLatin1Char('\n'));
  const int before = row >= 0 ? row : parent.isValid() ? parent.row() : rowCount();
  Q_EMIT order_wanted(moved(names, before));
  // The rows are put in their places by the decision; the view must not take any away.
  return false;
}

QStringList SceneModel::moved(const QStringList& scenes, int row) const {
  QStringList out;
  for (int k = 0; k <= rowCount(); ++k) {
    if (k == row) {
      for (const Row& r : rows_) {
        if (scenes.contains(r.name)) out << r.name;
      }
    }
    if (k < rowCount() && !scenes.contains(scene_at(k))) out << scene_at(k);
  }
  return out;
}

}  // namespace lvcalib::widgets

#include "moc_scene_model.cpp"
