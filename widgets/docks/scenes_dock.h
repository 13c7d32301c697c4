// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDockWidget>
#include <QStringList>

class QAction;
class QSortFilterProxyModel;
class QTreeView;

namespace lvcalib::widgets {

class SceneModel;
class ToolRow;

/// The scene list with what can be done to the selected scenes.
class ScenesDock : public QDockWidget {
  Q_OBJECT

 public:
  /// The model must outlive the dock.
  explicit ScenesDock(SceneModel& model, QWidget* parent = nullptr);

  [[nodiscard]] QStringList selected() const;
  /// Makes a scene the current one, as if it had been clicked.
  void select(const QString& scene);

 Q_SIGNALS:
  void scene_activated(const QString& scene);
  void use_wanted(const QStringList& scenes, bool use);
  /// Scenes that the program refused are to be used all the same, or no longer.
  void insist_wanted(const QStringList& scenes, bool insist);
  void run_again_wanted(const QStringList& scenes);
  void uncrop_wanted(const QStringList& scenes);
  void add_wanted();
  void note_wanted(const QString& scene, const QString& note);
  /// All scenes in the order that the user dragged them into.
  void order_wanted(const QStringList& scenes);

 protected:
  void changeEvent(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void make_view(SceneModel& model);
  void make_actions();
  void retranslate();
  void update_actions();
  /// Gives up thumbnails where the columns would not fit otherwise.
  void fit_columns();
  /// Width of the list that its columns cannot have.
  [[nodiscard]] int beside_rows() const;
  void move(int by);
  void edit_note();

  SceneModel& model_;
  QSortFilterProxyModel* sorted_;
  QTreeView* view_;
  ToolRow* tools_;
  QAction* accept_;
  QAction* insist_ = nullptr;
  QAction* reject_;
  QAction* run_again_;
  QAction* uncrop_;
  QAction* note_;
  QAction* up_;
  QAction* down_;
  QAction* add_;
};

}  // namespace lvcalib::widgets
