// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "modelling/where_pane.h"

class QLabel;
class QPushButton;

namespace lvcalib::widgets {

class AddEffectDialog;
class BudgetPlot;
class MissingPane;
class ModelWork;
class TermList;
class WhatIfPane;

/// Measurements of one scene: LiDAR returns and corners.
struct SceneSamples {
  std::vector<Eigen::Vector3d> points_in_lidar_m;
  std::vector<Eigen::Vector2d> pixels;
};
/// By the scenes' names.
using SamplesOfScenes = std::map<QString, SceneSamples>;

/// The Model page: compare, locate, learn, add, watch. Error history and budget on top; the model,
/// where it fails, and what is missing below. Work begins when the page is first seen.
class ModelPage : public QWidget {
  Q_OBJECT

 public:
  /// `work` must outlive the page.
  explicit ModelPage(ModelWork& work, QWidget* parent = nullptr);
  ~ModelPage() override;

  /// Why there is no model; empty if there may be one.
  void setReason(const Message& reason);
  /// The true T_camera_lidar, where it is known: how far from it the steps are is shown as well.
  void setTruth(const std::optional<Rigid3>& camera_from_lidar);

 Q_SIGNALS:
  /// The steps are to be set side by side.
  void compareWanted();
  /// These measurements are selected, and no others.
  void samplesSelected(const lvcalib::widgets::SamplesOfScenes& samples);
  /// The measurements that were selected last are to be left out.
  void excludeWanted();
  void failed(const QString& message);

 protected:
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void createLayout();
  void connectParts();
  void connectWork();
  void retranslate();
  void takeSteps();
  void takeRanking();
  void takeChosen(bool by_user);
  void describeSteps();
  void openDialog(const QString& covariate, std::optional<Channel> channel,
                  const QString& second = {});
  void forward(const std::vector<SelectedSample>& samples);

  ModelWork& work_;
  FigureSource source_;
  Message reason_;  // Why there is no model; empty: there is no calibration yet.
  ModelStepPtr shown_;
  bool pattern_is_proposal_ = true;  // Else it is a question of what if.
  bool follow_pattern_ = false;      // Until the user looks elsewhere.
  QLabel* title_;
  QLabel* legend_;
  QPushButton* compare_;
  BudgetPlot* budget_;
  TermList* terms_;
  WhatIfPane* what_if_;
  WherePane* where_;
  MissingPane* missing_;
};

}  // namespace lvcalib::widgets
