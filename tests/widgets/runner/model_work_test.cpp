// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/model_work.h"

#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <QUndoStack>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "runner/demo.h"
#include "runner/workspace.h"
#include "words/core_text.h"

namespace lvcalib::widgets::model_work_test {
namespace {

using ::testing::ElementsAre;

// Four small scenes of a LiDAR whose dark returns read far, calibrated once for all tests.
class Work : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new QTemporaryDir;
    auto options = demo_options();
    options.lidar.points = 60'000;
    options.image.width_px = 1000;
    options.image.height_px = 640;
    options.placement.max_distance_m = 2.8;
    workspace_ = new Workspace(folder_->path());
    workspace_->open_demo(options);
    ASSERT_TRUE(
        QTest::qWaitFor([] { return workspace_->is_open() && !workspace_->busy(); }, 240'000));
    workspace_->run();
    ASSERT_TRUE(
        QTest::qWaitFor([] { return workspace_->result() && !workspace_->busy(); }, 240'000));
  }
  static void TearDownTestSuite() {
    delete workspace_;
    delete folder_;
  }
  void SetUp() override {
    ASSERT_NE(workspace_->result(), nullptr);
    workspace_->undo_stack().clear();
    workspace_->set_model({});
    work_ = std::make_unique<ModelWork>(*workspace_);
  }
  bool idle() {
    return QTest::qWaitFor([&] { return !work_->busy(); }, 240'000);
  }
  std::vector<std::string> specs() {
    std::vector<std::string> out;
    if (work_->step()) {
      for (const ModelTerm& t : work_->step()->terms) out.push_back(t.spec);
    }
    return out;
  }
  static QTemporaryDir* folder_;
  static Workspace* workspace_;
  std::unique_ptr<ModelWork> work_;
};
QTemporaryDir* Work::folder_ = nullptr;
Workspace* Work::workspace_ = nullptr;

TEST_F(Work, FindsAddsAndTakesBackWhatIsHidden) {
  work_->start();
  ASSERT_TRUE(idle());
  ASSERT_NE(work_->step(), nullptr);
  ASSERT_NE(work_->ranking(), nullptr);
  EXPECT_EQ(work_->ranking()->proposals.front().finding.id, "range_walk");
  EXPECT_FALSE(workspace_->undo_stack().canUndo()) << "looking is no decision";
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return work_->result() && !work_->result()->budget.empty(); }, 60'000));
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  EXPECT_THAT(specs(), ElementsAre("range_walk"));
  EXPECT_EQ(work_->steps().size(), 2U);
  // By the name that the page gives it, in the language of the day.
  const auto* command = dynamic_cast<const DescribedCommand*>(workspace_->undo_stack().command(0));
  ASSERT_NE(command, nullptr);
  EXPECT_EQ(command->description(), "add Range walk");
  ASSERT_EQ(workspace_->model().size(), 1U);
  ASSERT_TRUE(QTest::qWaitFor([&] { return work_->result() != nullptr; }, 30'000));
  EXPECT_EQ(work_->result()->model.size(), 1U);
  // Once the rest of the catalogue was asked, the result holds the budget.
  EXPECT_TRUE(QTest::qWaitFor([&] { return !work_->result()->budget.empty(); }, 60'000));
  const auto discovery = work_->discovery();
  ASSERT_NE(discovery, nullptr);
  EXPECT_TRUE(discovery->holds("range_walk"));
  EXPECT_THAT(discovery->selected, ElementsAre()) << "the user added it";
  workspace_->undo_stack().undo();
  EXPECT_FALSE(work_->busy()) << "the step before is kept";
  EXPECT_THAT(specs(), ElementsAre());
  EXPECT_TRUE(workspace_->model().empty());
  // The base model is there at once, with its budget: exports have it whoever looked at it.
  ASSERT_NE(work_->result(), nullptr);
  EXPECT_FALSE(work_->behind());
  EXPECT_TRUE(work_->result()->model.empty());
  EXPECT_FALSE(work_->result()->budget.empty());
  EXPECT_FALSE(work_->result()->covariance_with_budget.isZero(0.0));
  EXPECT_EQ(work_->result()->extrinsic.camera_from_lidar.transform.matrix(),
            workspace_->result()->extrinsic.camera_from_lidar.transform.matrix());
  EXPECT_NE(work_->ranking(), nullptr);
  workspace_->undo_stack().redo();
  EXPECT_THAT(specs(), ElementsAre("range_walk"));
}

// As when a decision is taken back while the calibration with the model is still being made of it.
TEST_F(Work, AResultOfWhatIsForgottenDoesNotArrive) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return work_->result() != nullptr; }, 30'000));
  work_->go_to(0);
  ASSERT_TRUE(!work_->result() || work_->result()->model.empty());
  work_->go_to(1);
  Q_EMIT workspace_->opened();
  EXPECT_EQ(work_->result(), nullptr);
  EXPECT_FALSE(QTest::qWaitFor([&] { return work_->result() != nullptr; }, 1500));
}

TEST_F(Work, GoesBackInTheHistoryWithoutLosingIt) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  work_->add("board_bow");
  ASSERT_TRUE(idle());
  ASSERT_EQ(work_->steps().size(), 3U);
  work_->go_to(0);
  EXPECT_EQ(work_->current(), 0U);
  EXPECT_EQ(work_->steps().size(), 3U);
  EXPECT_TRUE(workspace_->model().empty());
  work_->go_to(2);
  EXPECT_EQ(specs().size(), 2U);
  // Something new from the middle takes the place of what followed.
  work_->go_to(1);
  ASSERT_TRUE(idle());
  work_->set_on(0, false);
  ASSERT_TRUE(idle());
  EXPECT_EQ(work_->steps().size(), 3U);
  EXPECT_TRUE(work_->step()->in_use().empty());
}

TEST_F(Work, HoldsAndReleasesValues) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  work_->hold(0, Eigen::VectorXd::Constant(1, 0.005));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(work_->step()->terms[0].use.held);
  EXPECT_DOUBLE_EQ(work_->step()->terms[0].use.values(0), 0.005);
  work_->hold(0, std::nullopt);
  ASSERT_TRUE(idle());
  EXPECT_FALSE(work_->step()->terms[0].use.held);
  EXPECT_GT(work_->step()->terms[0].use.values(0), 0.006);
  work_->remove(0);
  ASSERT_TRUE(idle());
  EXPECT_TRUE(specs().empty());
}

TEST_F(Work, FindsAllByItself) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->find_all();
  ASSERT_TRUE(idle());
  EXPECT_THAT(specs(), ::testing::Contains("range_walk"));
  EXPECT_TRUE(workspace_->undo_stack().canUndo());
  ASSERT_NE(work_->ranking(), nullptr);
  for (const EffectProposal& p : work_->ranking()->proposals) EXPECT_FALSE(p.suggested);
}

TEST_F(Work, AProjectsModelIsMadeAgain) {
  workspace_->set_model(
      {{ModelChange::kAdd, "range_walk", {}}, {ModelChange::kHold, "range_walk", {0.004}}});
  ASSERT_TRUE(workspace_->save(folder_->filePath("p.lvcalib")).ok());
  Workspace again(folder_->path());
  ModelWork work(again);
  again.open_project(folder_->filePath("p.lvcalib"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return again.is_open() && !again.busy(); }, 60'000));
  EXPECT_EQ(again.model().size(), 2U);
  again.run();
  ASSERT_TRUE(QTest::qWaitFor([&] { return work.step() != nullptr && !work.busy(); }, 240'000));
  ASSERT_EQ(work.step()->terms.size(), 1U);
  EXPECT_DOUBLE_EQ(work.step()->terms[0].use.values(0), 0.004);
  EXPECT_EQ(work.steps().size(), 3U);
}

// Wherever the user is: nobody asks for it.
TEST_F(Work, StartsWhenACalibrationIsThere) {
  QStringList logged;
  QObject::connect(work_.get(), &ModelWork::logged, work_.get(),
                   [&](const QString& line) { logged << line; });
  Q_EMIT workspace_->result_changed();
  EXPECT_TRUE(work_->busy());
  ASSERT_TRUE(idle());
  EXPECT_NE(work_->step(), nullptr);
  EXPECT_NE(work_->ranking(), nullptr);
  EXPECT_THAT(logged, ::testing::Contains(
                          QStringLiteral("Model: fitted again, as the calibration is another")));
}

TEST_F(Work, IsBehindUntilTheCalibrationWithTheModelIsMade) {
  work_->start();
  ASSERT_TRUE(idle());
  EXPECT_FALSE(work_->behind());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return work_->result() != nullptr; }, 30'000));
  EXPECT_FALSE(work_->behind());
  work_->go_to(0);
  EXPECT_FALSE(work_->behind());
  work_->go_to(1);
  EXPECT_TRUE(work_->behind());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !work_->behind(); }, 30'000));
  ASSERT_NE(work_->result(), nullptr);
  EXPECT_EQ(work_->result()->model.size(), 1U);
}

// From one effect to another: until the calibration with it is there, what is shown is out of date,
// and nothing is handed on.
TEST_F(Work, IsBehindBetweenTwoStepsWithEffects) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  work_->add("board_bow");
  ASSERT_TRUE(idle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return work_->result() && !work_->behind(); }, 30'000));
  ASSERT_EQ(work_->result()->model.size(), 2U);
  work_->go_to(1);
  EXPECT_TRUE(work_->behind() || work_->result()->model.size() == 1U);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !work_->behind(); }, 30'000));
  EXPECT_EQ(work_->result()->model.size(), 1U);
  // What is made of a step that was left meanwhile does not arrive.
  work_->go_to(2);
  ASSERT_TRUE(work_->behind());
  QThread::sleep(3);  // It is ready, and waits for this thread.
  work_->go_to(0);
  QTest::qWait(300);
  EXPECT_TRUE(!work_->result() || work_->result()->model.empty());
}

// Values that differ by less than a millionth of a metre or of nothing are others.
TEST_F(Work, SmallValuesThatAreHeldAreToldApart) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  work_->hold(0, Eigen::VectorXd::Constant(1, 1e-7));
  ASSERT_TRUE(idle());
  workspace_->undo_stack().undo();
  work_->hold(0, Eigen::VectorXd::Constant(1, 3e-7));
  ASSERT_TRUE(idle());
  EXPECT_DOUBLE_EQ(work_->step()->terms[0].use.values(0), 3e-7);
}

// Steps between are not asked for what is missing by a search for all: whoever comes back to one is
// told all the same.
TEST_F(Work, UndoAsksWhatIsMissingThere) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(QTest::qWaitFor([&] { return work_->current() == 1; }, 60'000));
  ASSERT_TRUE(work_->looking());
  // It goes on to the base at once, and what was looked for where nobody is any more ends.
  workspace_->undo_stack().undo();
  EXPECT_EQ(work_->current(), 0U);
  ASSERT_TRUE(idle());
  EXPECT_NE(work_->ranking(), nullptr);
  workspace_->undo_stack().redo();
  EXPECT_EQ(work_->current(), 1U);
  EXPECT_EQ(work_->ranking(), nullptr);
  EXPECT_TRUE(work_->looking());
  ASSERT_TRUE(idle());
  EXPECT_NE(work_->ranking(), nullptr);
}

// What is still being made when the user takes back what it stands on does not bring that back.
TEST_F(Work, UndoGivesUpWhatIsUnderWay) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(idle());
  work_->add("board_bow");
  workspace_->undo_stack().undo();
  ASSERT_TRUE(idle());
  QTest::qWait(100);
  EXPECT_THAT(specs(), ElementsAre());
  EXPECT_TRUE(workspace_->model().empty());
  EXPECT_TRUE(workspace_->undo_stack().canRedo());
}

// Pages show an added effect at once, while the rest of the catalogue is still asked: what is made
// for them does not share the processors with that search.
TEST_F(Work, AnAddedEffectArrivesWithItsCalibration) {
  work_->start();
  ASSERT_TRUE(idle());
  work_->add("range_walk");
  ASSERT_TRUE(QTest::qWaitFor([&] { return work_->steps().size() == 2 && work_->step(); }, 60'000));
  EXPECT_FALSE(work_->behind());
  ASSERT_NE(work_->result(), nullptr);
  EXPECT_EQ(work_->result()->model.size(), 1U);
  EXPECT_EQ(work_->ranking(), nullptr);
  ASSERT_TRUE(idle());
  EXPECT_NE(work_->ranking(), nullptr);
}

// A project of another version: what it names is said once and kept, and the rest is done.
TEST_F(Work, AnEffectThatThisVersionLacksIsCarried) {
  const std::vector<ModelDecision> decisions = {{ModelChange::kAdd, "quantum_foam", {}},
                                                {ModelChange::kAdd, "range_walk", {}}};
  workspace_->set_model(decisions);
  work_ = std::make_unique<ModelWork>(*workspace_);
  QStringList said;
  QObject::connect(work_.get(), &ModelWork::failed, work_.get(),
                   [&](const Error& error) { said << QString::fromStdString(error.text()); });
  Q_EMIT workspace_->opened();
  work_->start();
  ASSERT_TRUE(idle());
  ASSERT_EQ(said.size(), 1);
  EXPECT_TRUE(said[0].contains("quantum_foam"));
  EXPECT_THAT(specs(), ElementsAre("range_walk"));
  EXPECT_EQ(work_->steps().size(), 3U);
  EXPECT_EQ(workspace_->model(), decisions);
  // The history says that nothing came of it, and the report counts it as none.
  EXPECT_TRUE(work_->steps()[1]->without_change);
  EXPECT_FALSE(work_->steps()[2]->without_change);
  const auto discovery = work_->discovery();
  ASSERT_NE(discovery, nullptr);
  ASSERT_EQ(discovery->history.size(), 3U);
  EXPECT_EQ(discovery->history[1].added, "");
  EXPECT_EQ(discovery->history[2].added, "range_walk");
  work_->go_to(0);
  EXPECT_TRUE(specs().empty());
  workspace_->undo_stack().undo();
  EXPECT_THAT(specs(), ElementsAre("range_walk"));
  ASSERT_TRUE(idle());
  // Another calibration asks for it again, which is no news.
  const auto before = workspace_->result();
  workspace_->run_again({QStringLiteral("A")});
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return workspace_->result() != before && !work_->busy(); }, 240'000));
  EXPECT_THAT(specs(), ElementsAre("range_walk"));
  EXPECT_EQ(said.size(), 1);
}

TEST_F(Work, CancellingLeavesTheModelAsItWas) {
  work_->start();
  ASSERT_TRUE(idle());
  const ModelStepPtr before = work_->step();
  work_->add("range_cyclic");
  work_->cancel();
  ASSERT_TRUE(idle());
  EXPECT_EQ(work_->step(), before);
  EXPECT_FALSE(workspace_->undo_stack().canUndo());
}

TEST_F(Work, WhatCannotBeAddedIsSaid) {
  work_->start();
  ASSERT_TRUE(idle());
  QString message;
  QObject::connect(work_.get(), &ModelWork::failed, work_.get(),
                   [&](const Error& error) { message = QString::fromStdString(error.text()); });
  work_->add("formula:range:a*");
  ASSERT_TRUE(idle());
  EXPECT_FALSE(message.isEmpty());
  EXPECT_TRUE(specs().empty());
}

// As the search of the command line: the nearest board saturates the receiver, so its scene is
// refused, and shows best what is missing.
TEST(ModelWork, FindsAllWithASceneThatIsRefusedForWhatIsMissing) {
  QTemporaryDir folder;
  simulation::SimulationOptions options;
  options.seed = 6;
  options.scenes = 5;
  options.lidar.points = 120'000;
  options.effects["receiver_saturation"] = 10.0;
  Workspace workspace(folder.path());
  workspace.open_demo(options);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workspace.is_open() && !workspace.busy(); }, 240'000));
  ModelWork work(workspace);
  QStringList logged;
  QObject::connect(&work, &ModelWork::logged, &work, [&](const QString& line) { logged << line; });
  const auto settled = [&] {
    return QTest::qWaitFor(
        [&] {
          return workspace.up_to_date() && !workspace.busy() && !work.busy() && work.ranking() &&
                 !work.behind();
        },
        240'000);
  };
  workspace.run();
  ASSERT_TRUE(settled());
  ASSERT_FALSE(workspace.result()->scenes[4].used);
  DiscoveryOptions how = discovery_options(*workspace.result());
  how.advise_scenes = false;
  const auto expected = explain_refused_scenes(*workspace.result(), how, {});
  ASSERT_TRUE(expected.ok() && *expected);
  const CalibrationResult& explained = (*expected)->result;
  work.find_all();
  ASSERT_TRUE(QTest::qWaitFor([&] { return workspace.busy(); }, 240'000));
  ASSERT_TRUE(settled());
  EXPECT_THAT(logged, ::testing::Contains(core_text(explanations(**expected).front())));
  ASSERT_NE(work.result(), nullptr);
  const CalibrationResult& found = *work.result();
  ASSERT_EQ(found.model.size(), explained.model.size());
  for (std::size_t k = 0; k < found.model.size(); ++k)
    EXPECT_EQ(found.model[k].id, explained.model[k].id);
  EXPECT_EQ(found.quality, explained.quality);
  EXPECT_TRUE(found.scenes[4].used);
  EXPECT_TRUE(found.scenes[4].objection.empty());
  EXPECT_EQ(found.extrinsic.camera_from_lidar.transform.matrix(),
            explained.extrinsic.camera_from_lidar.transform.matrix());
  // The decision about the scene is the user's to take back, like the effects.
  EXPECT_TRUE(decision_of(workspace.decisions(), "E").insist);
  while (workspace.undo_stack().canUndo()) workspace.undo_stack().undo();
  EXPECT_FALSE(decision_of(workspace.decisions(), "E").insist);
  EXPECT_TRUE(workspace.model().empty());
}

}  // namespace
}  // namespace lvcalib::widgets::model_work_test
