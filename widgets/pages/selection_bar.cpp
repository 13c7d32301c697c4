// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/selection_bar.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <algorithm>

#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

void add_ids(std::vector<int>& to, const std::vector<int>& ids) {
  for (const int id : ids) {
    if (!contains_id(to, id)) to.push_back(id);
  }
  std::sort(to.begin(), to.end());
}

void remove_ids(std::vector<int>& from, const std::vector<int>& ids) {
  std::erase_if(from, [&](int id) { return contains_id(ids, id); });
}

bool any_of_them(const std::vector<int>& ids, const std::vector<int>& in) {
  return std::any_of(ids.begin(), ids.end(), [&](int id) { return contains_id(in, id); });
}

bool any_not_in(const std::vector<int>& ids, const std::vector<int>& in) {
  return std::any_of(ids.begin(), ids.end(), [&](int id) { return !contains_id(in, id); });
}

bool contains_part(const std::vector<BoardOutline>& parts, const BoardOutline& part) {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

Cloud cloud_of(const std::vector<Eigen::Vector3f>& points_m) {
  Cloud cloud;
  cloud.points_m = points_m;
  return cloud;
}

// What edits leave out of some points, by places among them.
std::vector<std::uint32_t> left_out_of(const std::vector<Eigen::Vector3f>& points_m,
                                       const SceneEdits& edits, const CalibrationResult& result,
                                       const SceneResult& scene) {
  if (points_m.empty() || !scene.refinement) return {};
  return left_out_points(cloud_of(points_m), edits, result.target,
                         scene.refinement->lidar_from_board);
}

}  // namespace

SelectionBar::SelectionBar(QWidget* parent)
    : QWidget(parent),
      text_(new QLabel(this)),
      exclude_(new QToolButton(this)),
      take_back_(new QToolButton(this)),
      keep_(new QToolButton(this)),
      patch_(new QAction(this)),
      patch_everywhere_(new QAction(this)) {
  text_->setObjectName(QStringLiteral("selection"));
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text_->setWordWrap(true);
  exclude_->setObjectName(QStringLiteral("exclude"));
  take_back_->setObjectName(QStringLiteral("take-back"));
  keep_->setObjectName(QStringLiteral("keep"));
  patch_->setObjectName(QStringLiteral("exclude-patch"));
  patch_everywhere_->setObjectName(QStringLiteral("exclude-patch-everywhere"));
  keep_->setCheckable(true);
  auto* menu = new QMenu(exclude_);
  menu->addActions({patch_, patch_everywhere_});
  exclude_->setMenu(menu);
  exclude_->setPopupMode(QToolButton::MenuButtonPopup);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(text_, 1);
  for (QToolButton* button : {exclude_, take_back_, keep_}) layout->addWidget(button);
  connect(exclude_, &QToolButton::clicked, this, &SelectionBar::exclude);
  connect(take_back_, &QToolButton::clicked, this, &SelectionBar::takeBack);
  connect(keep_, &QToolButton::clicked, this, &SelectionBar::keep);
  connect(patch_, &QAction::triggered, this, [this] {
    SceneEdits edits = edits_;
    edits.patches_m.push_back(patch());
    Q_EMIT editsWanted(edits);
  });
  connect(patch_everywhere_, &QAction::triggered, this,
          [this] { Q_EMIT patchEverywhereWanted(patch()); });
  follow_language(this, [this] { retranslate(); });
  setSelection({}, nullptr, nullptr);
}

void SelectionBar::retranslate() {
  exclude_->setText(tr("Exclude these"));
  exclude_->setToolTip(tr("Leave out what is selected, and solve again"));
  patch_->setText(tr("Exclude this patch of the board"));
  patch_->setToolTip(tr("Leave out every return on the part of the board that holds the points"));
  patch_everywhere_->setText(tr("Exclude this patch of the board in every scene"));
  patch_everywhere_->setToolTip(tr("For a stain, a screw or a bent corner: it is there always"));
  take_back_->setText(tr("Take back"));
  take_back_->setToolTip(tr("Use again what was left out of the selection by hand"));
  keep_->setText(tr("Use it all the same"));
  keep_->setToolTip(
      tr("Use the selected tags and circles although they miss the board's pose by more than the "
         "gate, and the parts of the board with the selected points although something seems to "
         "cover them"));
}

void SelectionBar::setText(const QString& text) {
  text_->setText(text);
}

void SelectionBar::setEdits(const SceneEdits& edits) {
  edits_ = edits;
  setSelection(std::move(selection_), result_, scene_);
}

// Of the selected tags or circles those that the program refuses and that can be used, or that are
// used all the same.
std::vector<int> SelectionBar::keepable(Refusal::What what) const {
  std::vector<int> out;
  if (result_ == nullptr || scene_ == nullptr) return out;
  const bool tags = what == Refusal::What::kTag;
  const auto& ids = tags ? selection_.tags : selection_.circles;
  const auto& kept = tags ? edits_.kept_tags : edits_.kept_circles;
  for (const int id : ids) {
    if (contains_id(kept, id)) out.push_back(id);
  }
  for (const Refusal& refusal : refusals(*result_)) {
    if (refusal.scene == scene_->name && refusal.what == what && refusal.can_be_used &&
        contains_id(ids, refusal.id))
      add_ids(out, {refusal.id});
  }
  return out;
}

bool SelectionBar::holdsSelected(const BoardOutline& part) const {
  SceneEdits one;
  one.patches_m = {part.corners_m()};
  return !left_out_of(selection_.points_m, one, *result_, *scene_).empty();
}

// The parts of the board that the program refuses, or that are used all the same, and that hold
// some of the selected points.
std::vector<BoardOutline> SelectionBar::keepableParts() const {
  std::vector<BoardOutline> out;
  if (result_ == nullptr || scene_ == nullptr || selection_.points_m.empty()) return out;
  std::vector<BoardOutline> parts = edits_.kept_patches;
  for (const Refusal& refusal : refusals(*result_)) {
    if (refusal.scene == scene_->name && refusal.what == Refusal::What::kPatch)
      parts.push_back({refusal.board_m.min(), refusal.board_m.max()});
  }
  for (const BoardOutline& part : parts) {
    if (holdsSelected(part) && std::find(out.begin(), out.end(), part) == out.end())
      out.push_back(part);
  }
  return out;
}

void SelectionBar::setSelection(SceneSelection selection, const CalibrationResult* result,
                                const SceneResult* scene) {
  selection_ = std::move(selection);
  result_ = result;
  scene_ = scene;
  bool out = false;
  bool back = false;
  bool points = false;
  if (result_ != nullptr && scene_ != nullptr) {
    const auto gone = left_out_of(selection_.points_m, edits_, *result_, *scene_);
    points = !selection_.points_m.empty();
    out = gone.size() < selection_.points_m.size() || any_not_in(selection_.tags, edits_.tags) ||
          any_not_in(selection_.circles, edits_.circles);
    back = !gone.empty() || any_of_them(selection_.tags, edits_.tags) ||
           any_of_them(selection_.circles, edits_.circles);
  }
  const auto tags = keepable(Refusal::What::kTag);
  const auto circles = keepable(Refusal::What::kCircle);
  const auto parts = keepableParts();
  const bool can_keep = !tags.empty() || !circles.empty() || !parts.empty();
  const bool parts_kept = std::all_of(parts.begin(), parts.end(), [&](const BoardOutline& part) {
    return contains_part(edits_.kept_patches, part);
  });
  exclude_->setVisible(out);
  patch_->setEnabled(points && scene_->refinement);
  patch_everywhere_->setEnabled(patch_->isEnabled());
  take_back_->setVisible(back);
  keep_->setVisible(can_keep);
  keep_->setChecked(can_keep && !any_not_in(tags, edits_.kept_tags) &&
                    !any_not_in(circles, edits_.kept_circles) && parts_kept);
}

std::vector<Eigen::Vector2d> SelectionBar::patch() const {
  return patch_about(selection_.points_m, scene_->refinement->lidar_from_board);
}

void SelectionBar::exclude() {
  SceneEdits edits = edits_;
  add_ids(edits.tags, selection_.tags);
  add_ids(edits.circles, selection_.circles);
  remove_ids(edits.kept_tags, selection_.tags);
  remove_ids(edits.kept_circles, selection_.circles);
  std::vector<bool> gone(selection_.points_m.size(), false);
  for (const std::uint32_t i : left_out_of(selection_.points_m, edits, *result_, *scene_))
    gone[i] = true;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i]) edits.points_m.push_back(selection_.points_m[i]);
  }
  Q_EMIT editsWanted(edits);
}

void SelectionBar::takeBack() {
  SceneEdits edits = edits_;
  remove_ids(edits.tags, selection_.tags);
  remove_ids(edits.circles, selection_.circles);
  // A patch goes as a whole if something of it is selected.
  std::erase_if(edits.patches_m, [&](const auto& patch) {
    SceneEdits one;
    one.patches_m = {patch};
    return !left_out_of(selection_.points_m, one, *result_, *scene_).empty();
  });
  SceneEdits selected;
  selected.points_m = selection_.points_m;
  const auto gone = left_out_of(edits.points_m, selected, *result_, *scene_);
  for (auto i = gone.rbegin(); i != gone.rend(); ++i)
    edits.points_m.erase(edits.points_m.begin() + *i);
  Q_EMIT editsWanted(edits);
}

void SelectionBar::keep(bool kept) {
  SceneEdits edits = edits_;
  const auto tags = keepable(Refusal::What::kTag);
  const auto circles = keepable(Refusal::What::kCircle);
  remove_ids(edits.kept_tags, tags);
  remove_ids(edits.kept_circles, circles);
  const auto parts = keepableParts();
  std::erase_if(edits.kept_patches,
                [&](const BoardOutline& part) { return contains_part(parts, part); });
  if (kept) {
    add_ids(edits.kept_tags, tags);
    add_ids(edits.kept_circles, circles);
    edits.kept_patches.insert(edits.kept_patches.end(), parts.begin(), parts.end());
  }
  Q_EMIT editsWanted(edits);
}

}  // namespace lvcalib::widgets

#include "moc_selection_bar.cpp"
