// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTimer>
#include <QWidget>
#include <map>
#include <memory>
#include <vector>

#include "pipeline/calibration.h"
#include "refinement/node_samples.h"
#include "views/color_map.h"

class QGridLayout;
class QLabel;
class QSlider;
class QTableWidget;
class QToolButton;

namespace lvcalib::widgets {

class AngleDistancePlot;
class BoardMapPlot;
class ConvergencePlot;

/// The refinement of one scene: an angle–distance plot for every node, one of them enlarged with a
/// list of its bins, the way of the centres over the board, convergence, and a slider that replays
/// the iterations. Live while it runs.
class RefinementPage : public QWidget {
  Q_OBJECT

 public:
  explicit RefinementPage(QWidget* parent = nullptr);
  ~RefinementPage() override;

  void setResult(std::shared_ptr<const CalibrationResult> result);
  void setScene(int index);
  /// The board to expect before there is a result: lets live plots take their places.
  void setTarget(const Target& target);
  /// Points of the scene's board for live plots before there is a result.
  void setLivePoints(int scene, std::shared_ptr<const Cloud> board_points);

  /// What is decided about the current scene's measurements.
  void setEdits(const SceneEdits& edits);

  [[nodiscard]] int iteration() const;
  [[nodiscard]] int chosenNode() const { return chosen_; }

 public Q_SLOTS:
  /// A refinement that is still running; shown if it is of the current scene.
  void showIteration(int scene, std::shared_ptr<const lvcalib::BoardRefinement> partial);
  void setIteration(int iteration);
  void chooseNode(int id);
  void play();

 Q_SIGNALS:
  /// The solve refused this circle; the user wants it used all the same.
  void keepWanted(const QString& scene, bool tag, int id);
  /// The scene's edits are to be these.
  void editsWanted(int scene, const lvcalib::SceneEdits& edits);
  void failed(const QString& message);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  /// Why a circle is not used though it could be refined.
  struct Refused {
    QString reason;
    bool can_be_used = false;
    bool by_hand = false;
  };
  QWidget* createDetail();
  QWidget* createDecisions();
  QWidget* createReplay();
  void retranslate();
  void display(std::shared_ptr<const BoardRefinement> refinement,
               std::shared_ptr<const Cloud> points, const QString& message);
  /// showResult(), once somebody sees it.
  void showResultLater();
  void showResult();
  void rebuildGrid();
  void updatePlots();
  void updateDetail();
  void fillBins(const NodeRecord* record);
  void showRecord(AngleDistancePlot& plot, const NodeRecord& record) const;
  /// Of each bin: not used, and left out by hand in what is shown.
  [[nodiscard]] std::vector<bool> binsByHand(const NodeRecord& record) const;
  [[nodiscard]] bool isByHand(int circle) const;
  void updateDecisions();
  void excludeBins();
  void takeBack();
  [[nodiscard]] std::vector<int> selectedBins() const;
  void selectBins(const std::vector<int>& bins, bool add);
  /// The patch covers nothing but some of the ring about the chosen circle.
  [[nodiscard]] bool isOfChosen(const std::vector<Eigen::Vector2d>& patch_m) const;
  void updateReplay();
  void advance();
  [[nodiscard]] const NodeRecord* record(int id) const;
  /// Of the circles of a finished scene.
  [[nodiscard]] std::map<int, Refused> refusedCircles() const;
  [[nodiscard]] QString nodeTitle(int id, bool narrow = false) const;

  std::shared_ptr<const CalibrationResult> result_;
  bool stale_ = false;  ///< What is shown is not yet the result's.
  std::shared_ptr<const BoardRefinement> refinement_;
  std::shared_ptr<const Cloud> points_;
  std::shared_ptr<const Cloud> live_points_;
  int live_points_scene_ = -1;
  Target target_;
  NodeSampler sampler_;
  ColorScale intensity_;
  double reach_m_ = 0.02;
  int scene_ = -1;
  int chosen_ = 0;
  QString message_;
  std::map<int, Refused> refused_;  // None while it runs.
  SceneEdits edits_;
  SceneEdits shown_edits_;  // With which the refinement shown was made.

  QTimer player_;
  QWidget* grid_ = nullptr;
  QGridLayout* grid_layout_ = nullptr;
  std::vector<AngleDistancePlot*> plots_;  // By place in target_.nodes().
  AngleDistancePlot* large_ = nullptr;
  QLabel* verdict_ = nullptr;
  QTableWidget* bins_ = nullptr;
  QToolButton* brush_ = nullptr;
  QToolButton* exclude_bins_ = nullptr;
  QToolButton* exclude_circle_ = nullptr;
  QToolButton* take_back_ = nullptr;
  BoardMapPlot* map_ = nullptr;
  ConvergencePlot* convergence_ = nullptr;
  QSlider* slider_ = nullptr;
  QToolButton* play_ = nullptr;
  QLabel* iteration_text_ = nullptr;
  QLabel* notice_ = nullptr;  // In place of the small plots, if the board has no circles.
};

}  // namespace lvcalib::widgets
