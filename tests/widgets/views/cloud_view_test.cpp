// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_view.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QMenu>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "pages/cloud_pane.h"
#include "support/timing.h"
#include "views/cloud_scene_builder.h"
#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::cloud_view_test {
namespace {

// A wall three metres ahead, 4 m × 3 m, its left half of low intensity.
std::shared_ptr<const Cloud> wall(std::size_t points) {
  Random random(1);
  auto cloud = std::make_shared<Cloud>();
  cloud->points_m.reserve(points);
  cloud->intensity.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double y = random.uniform(-2.0, 2.0);
    const double z = random.uniform(-1.5, 1.5);
    cloud->points_m.push_back({3.0F, static_cast<float>(y), static_cast<float>(z)});
    cloud->intensity.push_back(y > 0 ? 10.0F : 100.0F);
  }
  return cloud;
}

std::shared_ptr<const CloudScene> scene_of(const std::shared_ptr<const Cloud>& cloud) {
  CloudSceneInput input;
  input.full = cloud;
  return build_cloud_scene(input, {});
}

class CloudViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!opengl_available()) GTEST_SKIP() << "no OpenGL 3.2 here (run under xvfb-run)";
    view_.setPalette(test::palette_of(true));
    view_.resize(640, 480);
    view_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view_));
  }
  bool settle(int at_most_ms = 20'000) {
    return QTest::qWaitFor([&] { return view_.canvas()->complete(); }, at_most_ms);
  }
  // Share of the canvas that is not background.
  double covered() {
    const QImage image = view_.canvas()->grabFramebuffer();
    const QRgb ground = view_.palette().color(QPalette::Base).rgb();
    int other = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) other += (image.pixel(x, y) | 0xff000000U) != ground;
    }
    return static_cast<double>(other) / (image.width() * image.height());
  }
  QPoint middle() { return view_.canvas()->rect().center(); }
  CloudView view_;
};

TEST_F(CloudViewTest, DrawsAllPointsInTheirColours) {
  view_.setScene(scene_of(wall(300'000)));
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  EXPECT_EQ(view_.canvas()->pipeline().drawnPoints(), 300'000U);
  EXPECT_GT(covered(), 0.5);
  // From the sensor, +y is left: the dark half.
  const QImage image = view_.canvas()->grabFramebuffer();
  int left = 0;
  int right = 0;
  for (int dy = -40; dy <= 40; ++dy) {
    left += qGreen(image.pixel(middle().x() - 60, middle().y() + dy));
    right += qGreen(image.pixel(middle().x() + 60, middle().y() + dy));
  }
  EXPECT_GT(right, 2 * left);
}

TEST_F(CloudViewTest, PortionsAddUpToOnePicture) {
  view_.setScene(scene_of(wall(400'000)));
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  EXPECT_GT(view_.canvas()->statistics().portions, 0);
  const QImage once = view_.canvas()->grabFramebuffer();
  // Painting again without need does not change it.
  view_.canvas()->update();
  QTest::qWait(50);
  EXPECT_EQ(view_.canvas()->grabFramebuffer(), once);
}

// A layout that changes, as for another language, costs one picture.
TEST_F(CloudViewTest, AnotherSizeIsDrawnOnce) {
  view_.setScene(scene_of(wall(50'000)));
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  QTest::qWait(100);
  const auto before = view_.canvas()->statistics().frames;
  view_.resize(600, 500);
  ASSERT_TRUE(QTest::qWaitFor([&] { return view_.canvas()->statistics().frames > before; }));
  ASSERT_TRUE(settle());
  EXPECT_EQ(view_.canvas()->statistics().frames, before + 1);
  EXPECT_GT(covered(), 0.1);
}

TEST_F(CloudViewTest, AClickPicksThePointUnderIt) {
  const auto cloud = wall(200'000);
  view_.setScene(scene_of(cloud));
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  QSignalSpy picked(&view_, &CloudView::pointPicked);
  QTest::mouseClick(view_.canvas(), Qt::LeftButton, {}, middle());
  ASSERT_EQ(picked.size(), 1);
  const Eigen::Vector3f p = cloud->points_m[picked[0][0].toUInt()];
  // The middle of the view is where the sensor looks: the median of the points.
  EXPECT_LT((p.cast<double>() - view_.scene()->center_m).norm(), 0.06);
  QSignalSpy nothing(&view_, &CloudView::nothingPicked);
  QTest::mouseClick(view_.canvas(), Qt::LeftButton, {}, QPoint(3, 3));
  EXPECT_EQ(nothing.size() + picked.size(), 2);
  view_.setHighlights({picked[0][0].toUInt()});
  ASSERT_TRUE(settle());
}

TEST_F(CloudViewTest, DraggingTurnsAndKeysReset) {
  view_.setScene(scene_of(wall(50'000)));
  QTest::qWait(50);  // The legend takes its place beside the canvas.
  ASSERT_TRUE(settle());
  const Eigen::Matrix4d start = view_.canvas()->pipeline().clipFromWorld();
  QTest::mousePress(view_.canvas(), Qt::LeftButton, {}, middle());
  for (int k = 1; k <= 8; ++k) QTest::mouseMove(view_.canvas(), middle() + QPoint(10 * k, 3 * k));
  QTest::mouseRelease(view_.canvas(), Qt::LeftButton, {}, middle() + QPoint(80, 24));
  ASSERT_TRUE(settle());
  EXPECT_GT((view_.canvas()->pipeline().clipFromWorld() - start).norm(), 0.1);
  view_.canvas()->setFocus();
  QTest::keyClick(view_.canvas(), Qt::Key_R);
  ASSERT_TRUE(settle());
  EXPECT_LT((view_.canvas()->pipeline().clipFromWorld() - start).norm(), 1e-6);
  QTest::keyClick(view_.canvas(), Qt::Key_T);
  ASSERT_TRUE(settle());
  const Eigen::Matrix4d top = view_.canvas()->pipeline().clipFromWorld();
  EXPECT_GT((top - start).norm(), 0.1);
  QTest::keyClick(view_.canvas(), Qt::Key_Left);
  EXPECT_GT((view_.canvas()->pipeline().clipFromWorld() - top).norm(), 0.01);
}

TEST_F(CloudViewTest, FliesFromViewToView) {
  view_.setScene(scene_of(wall(50'000)));
  QTest::qWait(50);
  ASSERT_TRUE(settle());
  const Viewer start = view_.canvas()->pipeline().viewer();
  std::vector<Eigen::Vector3d> places;
  QObject::connect(view_.canvas(), &CloudCanvas::begun, &view_,
                   [&] { places.push_back(view_.canvas()->pipeline().viewer().eye_m); });
  view_.canvas()->setFocus();
  QTest::keyClick(view_.canvas(), Qt::Key_T);
  EXPECT_FALSE(view_.canvas()->complete());
  ASSERT_TRUE(settle());
  const Viewer end = view_.canvas()->pipeline().viewer();
  const double way_m = (end.eye_m - start.eye_m).norm();
  ASSERT_GT(way_m, 0.5);
  const auto under_way = std::count_if(places.begin(), places.end(), [&](const auto& p) {
    return (p - start.eye_m).norm() > 0.02 * way_m && (p - end.eye_m).norm() > 0.02 * way_m;
  });
  EXPECT_GE(under_way, 3);
  // A key that turns does so from where the flight goes to.
  QTest::keyClick(view_.canvas(), Qt::Key_R);
  QTest::keyClick(view_.canvas(), Qt::Key_Plus);
  ASSERT_TRUE(settle());
  EXPECT_LT((view_.canvas()->pipeline().viewer().focus_m - start.focus_m).norm(), 1e-6);
}

// Lines lie in the surface about which the points scatter: they are seen all the same, and of two
// in one place both are. What stands before them still hides them.
TEST_F(CloudViewTest, LinesAreSeenAmongThePointsTheyLieIn) {
  Random random(2);
  const auto rough_wall = [&](double distance_m) {
    auto cloud = std::make_shared<Cloud>(*wall(300'000));
    for (Eigen::Vector3f& p : cloud->points_m)
      p.x() = static_cast<float>(distance_m + 0.02 * random.normal());
    return cloud;
  };
  const auto pixels = [&](const std::array<double, 3>& color) {
    const QImage image = view_.canvas()->grabFramebuffer();
    const QColor wanted = QColor::fromRgbF(
        static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]));
    int out = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const QColor at = image.pixelColor(x, y);
        out += std::abs(at.red() - wanted.red()) + std::abs(at.green() - wanted.green()) +
                   std::abs(at.blue() - wanted.blue()) <
               12;
      }
    }
    return out;
  };
  const std::array<double, 3> orange{1.0, 0.6, 0.0};
  const std::array<double, 3> blue{0.15, 0.55, 1.0};
  const std::vector<Eigen::Vector3d> square{
      {3, -0.5, -0.5}, {3, 0.5, -0.5}, {3, 0.5, 0.5}, {3, -0.5, 0.5}};
  view_.setScene(scene_of(rough_wall(3.0)));
  view_.setPointSize(3.0);
  view_.setLines({{square, blue, true}, {square, orange, true, CloudLineWidth::kBroad}});
  view_.look(CloudViewpoint::kSensor);
  QTest::qWait(50);
  ASSERT_TRUE(settle());
  const Eigen::Matrix4d clip = view_.canvas()->pipeline().clipFromWorld();
  const auto in_view = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector4d c = clip * p.homogeneous();
    return c.y() / c.w();
  };
  const double side_px =
      0.5 * view_.canvas()->height() * std::abs(in_view(square[2]) - in_view(square[1]));
  ASSERT_GT(side_px, 40.0);
  EXPECT_GT(pixels(blue), 0.9 * 4.0 * side_px);
  EXPECT_GT(pixels(orange), 0.9 * 4.0 * side_px);
  view_.setScene(scene_of(rough_wall(2.0)));
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  EXPECT_LT(pixels(blue), 0.2 * 4.0 * side_px);
}

TEST_F(CloudViewTest, MarksStayWhenThePointsAreColouredAnew) {
  const auto cloud = wall(50'000);
  const auto scene = scene_of(cloud);
  view_.setScene(scene);
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  const auto magenta = [&] {
    const QImage image = view_.canvas()->grabFramebuffer();
    int out = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const QColor at = image.pixelColor(x, y);
        out += at.red() > 240 && at.green() < 100 && at.blue() > 160;
      }
    }
    return out;
  };
  EXPECT_EQ(magenta(), 0);
  view_.setHighlights({10, 20});
  ASSERT_TRUE(settle());
  const int marked = magenta();
  EXPECT_GT(marked, 20);
  CloudSceneInput input;
  input.full = cloud;
  input.color = CloudColor::kHeight;
  view_.setScene(build_cloud_scene(input, {}));
  QTest::qWait(50);
  ASSERT_TRUE(settle());
  EXPECT_NEAR(magenta(), marked, 0.2 * marked);
  view_.setHighlights({});
  ASSERT_TRUE(settle());
  EXPECT_EQ(magenta(), 0);
}

// Whole before the board is found, and the board large in the middle from then on; a viewer who has
// turned away stays where he is when the same cloud is coloured anew.
TEST_F(CloudViewTest, TheBoardIsFramedOnceItIsFound) {
  const auto cloud = wall(50'000);
  view_.setScene(scene_of(cloud));
  ASSERT_TRUE(settle());
  EXPECT_LT((view_.canvas()->pipeline().viewer().focus_m - view_.scene()->center_m).norm(), 0.2);
  auto found = std::make_shared<CloudScene>(*scene_of(cloud));
  found->board_center_m = {3.0, 1.2, -0.8};
  found->board_radius_m = 0.5;
  found->board_normal = -Eigen::Vector3d::UnitX();
  std::vector<Eigen::Vector3d> places;
  const Eigen::Vector3d start = view_.canvas()->pipeline().viewer().eye_m;
  QObject::connect(view_.canvas(), &CloudCanvas::begun, &view_,
                   [&] { places.push_back(view_.canvas()->pipeline().viewer().eye_m); });
  view_.setScene(found);
  ASSERT_TRUE(settle());
  view_.canvas()->disconnect(&view_);
  // It is flown there: who looks on sees what comes into sight.
  const Eigen::Vector3d end = view_.canvas()->pipeline().viewer().eye_m;
  const double way_m = (end - start).norm();
  EXPECT_GE(std::count_if(places.begin(), places.end(),
                          [&](const Eigen::Vector3d& p) {
                            return (p - start).norm() > 0.02 * way_m &&
                                   (p - end).norm() > 0.02 * way_m;
                          }),
            3);
  const auto in_view = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector4d clip = view_.canvas()->pipeline().clipFromWorld() * p.homogeneous();
    return Eigen::Vector2d(clip.x() / clip.w(), clip.y() / clip.w());
  };
  EXPECT_LT(in_view(found->board_center_m).norm(), 0.1);
  for (const double side : {-1.0, 1.0}) {
    const double reach = in_view(found->board_center_m + Eigen::Vector3d(0, 0, 0.5 * side)).norm();
    EXPECT_GT(reach, 0.4);
    EXPECT_LT(reach, 1.0);
  }
  QTest::keyClick(view_.canvas(), Qt::Key_Left);
  ASSERT_TRUE(settle());
  const Viewer turned = view_.canvas()->pipeline().viewer();
  view_.setScene(std::make_shared<CloudScene>(*found));
  ASSERT_TRUE(settle());
  EXPECT_LT((view_.canvas()->pipeline().viewer().eye_m - turned.eye_m).norm(), 1e-9);
}

TEST_F(CloudViewTest, AViewOfOnesOwnIsKeptWhenTheBoardIsFound) {
  const auto cloud = wall(50'000);
  view_.setScene(scene_of(cloud));
  ASSERT_TRUE(settle());
  QTest::keyClick(view_.canvas(), Qt::Key_Left);
  ASSERT_TRUE(settle());
  const Viewer turned = view_.canvas()->pipeline().viewer();
  auto found = std::make_shared<CloudScene>(*scene_of(cloud));
  found->board_center_m = {3.0, 1.2, -0.8};
  found->board_radius_m = 0.5;
  found->board_normal = -Eigen::Vector3d::UnitX();
  view_.setScene(found);
  ASSERT_TRUE(settle());
  EXPECT_LT((view_.canvas()->pipeline().viewer().eye_m - turned.eye_m).norm(), 1e-9);
  // Another cloud is framed anew.
  auto other = std::make_shared<CloudScene>(*scene_of(wall(40'000)));
  view_.setScene(other);
  ASSERT_TRUE(settle());
  EXPECT_GT((view_.canvas()->pipeline().viewer().eye_m - turned.eye_m).norm(), 1e-3);
}

// What the cloud alone says is likely comes into sight at once; what a calibration has found there
// or elsewhere takes its place.
TEST_F(CloudViewTest, TheLikelyBoardIsFramedAndGivesWayToTheOneFound) {
  const auto cloud = wall(50'000);
  const auto focus_with = [&](const Eigen::Vector3d& center_m, bool is_likely) {
    auto scene = std::make_shared<CloudScene>(*scene_of(cloud));
    scene->board_center_m = center_m;
    scene->board_radius_m = 0.5;
    scene->board_normal = -Eigen::Vector3d::UnitX();
    scene->board_is_likely = is_likely;
    view_.setScene(scene);
    EXPECT_TRUE(settle());
    return view_.canvas()->pipeline().viewer().focus_m;
  };
  view_.setScene(scene_of(cloud));
  ASSERT_TRUE(settle());
  const Eigen::Vector3d likely(3.0, 1.2, -0.8);
  const Eigen::Vector3d found(3.0, -0.9, 0.4);
  EXPECT_LT((focus_with(likely, true) - likely).norm(), 1e-6);
  EXPECT_LT((focus_with(found, false) - found).norm(), 1e-6);
  EXPECT_LT((focus_with(likely, true) - found).norm(), 1e-6) << "not back again";
}

// A few returns from far away make the rest no speck when a cloud is opened; Reset shows them, too.
TEST_F(CloudViewTest, OpensOnWhatMostPointsShow) {
  view_.setScene(scene_of(wall(50'000)));
  ASSERT_TRUE(settle());
  const double usual = covered();
  auto far = std::make_shared<Cloud>(*wall(50'000));
  for (int k = 0; k < 20; ++k) {
    far->points_m.push_back({60.0F + static_cast<float>(k), 30.0F, 2.0F});
    far->intensity.push_back(1.0F);
  }
  view_.setScene(scene_of(far));
  ASSERT_TRUE(settle());
  EXPECT_GT(covered(), 0.8 * usual);
  QTest::keyClick(view_.canvas(), Qt::Key_R);
  ASSERT_TRUE(settle());
  EXPECT_LT(covered(), 0.2 * usual);
}

TEST_F(CloudViewTest, PointSizeAxesAndGridAreChosenInTheToolBar) {
  CloudPane pane;
  pane.setPalette(test::palette_of(true));
  pane.resize(700, 560);
  pane.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&pane));
  CloudSceneInput input;
  input.full = wall(2000);
  pane.setInput(std::move(input), {});
  CloudView* view = pane.view();
  ASSERT_TRUE(QTest::qWaitFor([&] { return view->scene() != nullptr; }, 10'000));
  const auto picture = [&] {
    QTest::qWait(50);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view->canvas()->complete(); }, 10'000));
    return view->canvas()->grabFramebuffer();
  };
  const auto inked = [](const QImage& image) {
    const QRgb ground = image.pixel(0, 0);
    int out = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) out += image.pixel(x, y) != ground ? 1 : 0;
    }
    return out;
  };
  const QImage small = picture();
  auto* size = pane.findChild<QDoubleSpinBox*>("cloud-point-size");
  ASSERT_NE(size, nullptr);
  size->setValue(6.0);
  EXPECT_GT(inked(picture()), 3 * inked(small));
  size->setValue(CloudView::kPointSize_px);
  auto* axes = pane.findChild<QAction*>("cloud-axes");
  ASSERT_NE(axes, nullptr);
  axes->setChecked(true);
  EXPECT_GT(inked(picture()), inked(small) + 500);
  axes->setChecked(false);
  EXPECT_EQ(inked(picture()), inked(small));
}

TEST_F(CloudViewTest, SaysWhenTheBoardIsSeenFromBehind) {
  auto scene = std::make_shared<CloudScene>(*scene_of(wall(50'000)));
  scene->board_center_m = scene->center_m;
  scene->board_radius_m = 0.5;
  scene->board_normal = -scene->center_m.normalized();  // Towards the sensor.
  view_.setScene(scene);
  ASSERT_TRUE(settle());
  auto* side = view_.findChild<QLabel*>("cloud-side");
  QTest::qWait(20);
  EXPECT_FALSE(side->isVisible());
  Viewer viewer = view_.canvas()->pipeline().viewer();
  viewer.eye_m = scene->center_m - 2.0 * scene->board_normal;
  view_.canvas()->pipeline().setViewer(viewer);
  view_.canvas()->viewMoved();
  EXPECT_TRUE(QTest::qWaitFor([&] { return side->isVisible(); }, 2000));
  view_.look(CloudViewpoint::kSensor);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !side->isVisible(); }, 2000));
}

TEST_F(CloudViewTest, WheelZooms) {
  view_.setScene(scene_of(wall(50'000)));
  ASSERT_TRUE(settle());
  const double before = covered();
  for (int k = 0; k < 5; ++k) {
    QWheelEvent wheel(middle(), view_.canvas()->mapToGlobal(middle()), {}, QPoint(0, -120),
                      Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(view_.canvas(), &wheel);
  }
  ASSERT_TRUE(settle());
  EXPECT_LT(covered(), 0.8 * before);
}

TEST_F(CloudViewTest, BoxIsMovedByItsHandle) {
  view_.setScene(scene_of(wall(50'000)));
  CropBox box;
  box.center_m = {3, 0, 0};
  box.half_size_m = {0.3, 0.5, 0.5};
  view_.setBox(box, true);
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  QSignalSpy edited(&view_, &CloudView::boxEdited);
  QSignalSpy picked(&view_, &CloudView::pointPicked);
  // The handle in the middle of the box moves it; as does dragging the face before it.
  QTest::mousePress(view_.canvas(), Qt::LeftButton, Qt::ShiftModifier, middle());
  for (int k = 1; k <= 6; ++k) QTest::mouseMove(view_.canvas(), middle() + QPoint(8 * k, 0));
  QTest::mouseRelease(view_.canvas(), Qt::LeftButton, {}, middle() + QPoint(48, 0));
  ASSERT_GE(edited.size(), 1);
  const auto moved = edited.back()[0].value<CropBox>();
  EXPECT_TRUE(check(moved).ok());
  EXPECT_GT((moved.center_m - box.center_m).norm() + (moved.half_size_m - box.half_size_m).norm(),
            0.02);
  EXPECT_EQ(picked.size(), 0);
}

TEST_F(CloudViewTest, BoxComesBackAsItWasSet) {
  view_.setScene(scene_of(wall(1000)));
  CropBox box;
  box.center_m = {3, 0.2, -0.1};
  box.half_size_m = {0.3, 0.5, 0.8};
  box.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 0).normalized());
  view_.setBox(box, true);
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  QSignalSpy edited(&view_, &CloudView::boxEdited);
  QTest::mouseClick(view_.canvas(), Qt::LeftButton, {}, middle());
  for (const auto& signal : edited) {
    const auto same = signal[0].value<CropBox>();
    EXPECT_LT((same.center_m - box.center_m).norm(), 1e-9);
    EXPECT_LT((same.half_size_m - box.half_size_m).norm(), 1e-9);
    EXPECT_LT(same.rotation.angularDistance(box.rotation), 1e-6);
  }
}

TEST_F(CloudViewTest, LinesAreDrawnAndHideWhenGone) {
  view_.setScene(scene_of(wall(1000)));
  view_.look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  const double before = covered();
  view_.setLines({{{{3, -1, -1}, {3, 1, -1}, {3, 1, 1}, {3, -1, 1}}, {1.0, 0.6, 0.0}, true}});
  ASSERT_TRUE(settle());
  EXPECT_GT(covered(), before + 0.002);
  EXPECT_TRUE(test::shows(view_, QColor(255, 153, 0)));
  view_.setLines({});
  ASSERT_TRUE(settle());
  EXPECT_NEAR(covered(), before, 1e-4);
}

TEST_F(CloudViewTest, SavesAPicture) {
  view_.setScene(scene_of(wall(100'000)));
  ASSERT_TRUE(settle());
  const QTemporaryDir folder;
  ASSERT_TRUE(view_.figureActions()->save(folder.filePath("c.png")));
  ASSERT_TRUE(view_.figureActions()->save(folder.filePath("c.pdf")));
  QSet<QRgb> colours;
  const QImage image(folder.filePath("c.png"));
  for (int x = 0; x < image.width(); ++x) colours.insert(image.pixel(x, image.height() / 2));
  EXPECT_GT(colours.size(), 2);
}

TEST_F(CloudViewTest, SurvivesAnotherWindowAndNoScene) {
  view_.setScene(scene_of(wall(60'000)));
  ASSERT_TRUE(settle());
  view_.setScene(nullptr);
  ASSERT_TRUE(settle());
  view_.setScene(scene_of(wall(60'000)));
  // Another parent means another window and another context.
  QWidget other;
  other.resize(700, 500);
  view_.setParent(&other);
  other.show();
  view_.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&other));
  view_.canvas()->redraw();
  ASSERT_TRUE(settle());
  EXPECT_GT(covered(), 0.05);
  EXPECT_LT(covered(), 0.95);
  view_.setParent(nullptr);
}

// A view that is first shown when its tab is chosen, after the window.
TEST_F(CloudViewTest, DrawsInATabThatIsShownLate) {
  QTabWidget tabs;
  tabs.setPalette(test::palette_of(true));
  tabs.resize(640, 480);
  tabs.addTab(new QWidget, "first");
  auto* late = new CloudView;
  tabs.addTab(late, "second");
  tabs.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&tabs));
  late->setScene(scene_of(wall(60'000)));
  QTest::qWait(100);
  tabs.setCurrentIndex(1);
  ASSERT_TRUE(QTest::qWaitFor([&] { return late->canvas()->complete(); }, 5000));
  const QImage image = late->canvas()->grabFramebuffer();
  EXPECT_EQ(image.pixel(image.width() - 3, 3), QColor(30, 30, 30).rgb());
  EXPECT_EQ(image.pixel(3, image.height() - 3), QColor(30, 30, 30).rgb());
  EXPECT_GT(test::colours_shown(*late), 20);
}

// Five million points: shown within two seconds of being read, and turning at 20 frames a second.
TEST_F(CloudViewTest, FiveMillionPointsTurnSmoothly) {
  view_.resize(900, 700);
  const auto cloud = wall(5'000'000);
  CloudSceneBuilder builder;
  QObject::connect(&builder, &CloudSceneBuilder::ready, &view_, &CloudView::setScene);
  CloudSceneInput input;
  input.full = cloud;
  const int frames_before = view_.canvas()->statistics().frames;
  QElapsedTimer clock;
  clock.start();
  builder.request(std::move(input));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return view_.scene() && view_.scene()->size() == 5'000'000 &&
               view_.canvas()->statistics().frames > frames_before;
      },
      20'000));
  const auto shown_ms = clock.elapsed();
  ASSERT_TRUE(settle(60'000));
  const auto complete_ms = clock.elapsed();

  std::vector<double> gaps_ms;
  QElapsedTimer turn;
  QTest::mousePress(view_.canvas(), Qt::LeftButton, {}, middle());
  for (int k = 1; k <= 60; ++k) {
    const int before = view_.canvas()->statistics().frames;
    turn.start();
    QTest::mouseMove(view_.canvas(), middle() + QPoint(3 * k, k));
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return view_.canvas()->statistics().frames > before; }, 5000));
    gaps_ms.push_back(1e-6 * static_cast<double>(turn.nsecsElapsed()));
  }
  QTest::mouseRelease(view_.canvas(), Qt::LeftButton, {}, middle() + QPoint(180, 60));
  std::sort(gaps_ms.begin(), gaps_ms.end());
  const double median_ms = gaps_ms[gaps_ms.size() / 2];
  RecordProperty("shown_ms", static_cast<int>(shown_ms));
  RecordProperty("complete_ms", static_cast<int>(complete_ms));
  RecordProperty("turning_frame_ms", static_cast<int>(median_ms));
  std::printf(
      "5 M points: shown after %lld ms, complete after %lld ms; turning %.1f ms a frame "
      "(worst %.1f)\n",
      static_cast<long long>(shown_ms), static_cast<long long>(complete_ms), median_ms,
      gaps_ms.back());
  // The goal is 2 s and 50 ms; a machine that does other things at the same time is slower.
  EXPECT_LT(shown_ms, ::lvcalib::test::time_limit(8000));
  EXPECT_LT(median_ms, ::lvcalib::test::time_limit(50.0));
}

TEST(CloudViewWithoutOpenGl, ShowsAMessageAndKeepsWorking) {
  if (opengl_available()) GTEST_SKIP() << "this screen has OpenGL";
  CloudView view;
  view.resize(400, 300);
  view.show();
  EXPECT_FALSE(view.hasOpenGl());
  EXPECT_NE(view.findChild<QWidget*>("no-opengl"), nullptr);
  view.setScene(scene_of(wall(100)));
  view.setBox(CropBox(), true);
  view.setHighlights({1});
  view.look(CloudViewpoint::kTop);
  QTest::keyClick(&view, Qt::Key_R);
  EXPECT_GT(test::colours_shown(view), 3);
}

}  // namespace
}  // namespace lvcalib::widgets::cloud_view_test
