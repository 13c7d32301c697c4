// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/scene_data.h"

#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "support/image_files.h"

namespace lvcalib::widgets::scene_data_test {
namespace {

class SceneData : public ::testing::Test {
 protected:
  SceneFiles files(const std::string& name) const {
    return {name,
            folder_.filePath("image.png").toStdString(),
            folder_.filePath("cloud.pcd").toStdString(),
            {}};
  }
  void write_scene(int type) const {
    cv::Mat mat(40, 60, type, cv::Scalar::all(type == CV_16UC1 ? 257 * 200 : 200));
    test::write_png(folder_.filePath("image.png").toStdString(), mat);
    Cloud cloud;
    cloud.points_m = {{1, 2, 3}, {4, 5, 6}};
    cloud.intensity = {7, 8};
    ASSERT_TRUE(write_pcd(folder_.filePath("cloud.pcd").toStdString(), cloud).ok());
  }
  QTemporaryDir folder_;
};

TEST_F(SceneData, ReadsCloudAndImagesOfEveryDepth) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1}) {
    write_scene(type);
    const auto data = read_scene_data(files("A"), {});
    ASSERT_TRUE(data.ok()) << data.error().text();
    EXPECT_EQ(data->cloud->size(), 2U);
    EXPECT_EQ(data->image.size(), QSize(60, 40));
    EXPECT_EQ(data->image.pixelColor(30, 20), QColor(200, 200, 200)) << type;
  }
}

TEST_F(SceneData, TheLoaderGivesDataThumbnailsAndMessages) {
  write_scene(CV_8UC3);
  SceneLoader loader;
  QSignalSpy loaded(&loader, &SceneLoader::loaded);
  QSignalSpy thumbnails(&loader, &SceneLoader::thumbnail);
  QSignalSpy failed(&loader, &SceneLoader::failed);
  loader.load(files("A"));
  ASSERT_TRUE(loaded.wait(5000));
  EXPECT_EQ(loaded.first().first().toString(), "A");
  SceneFiles broken = files("C");
  broken.image = "/nowhere.png";
  loader.load_thumbnails({files("A"), broken, files("B")});
  while (thumbnails.count() < 2 && thumbnails.wait(5000)) {
  }
  ASSERT_EQ(thumbnails.count(), 2);
  ASSERT_EQ(failed.count(), 1) << "the broken one is named at once";
  EXPECT_EQ(thumbnails.last().first().toString(), "B");
  EXPECT_EQ(qvariant_cast<QImage>(thumbnails.last().at(1)).size(), QSize(45, 30));
  loader.load(broken);
  ASSERT_TRUE(failed.wait(5000));
  EXPECT_TRUE(QString::fromStdString(qvariant_cast<Message>(failed.last().at(1)).text())
                  .contains("nowhere.png"));
  // The cloud is shown without its image.
  const auto data = qvariant_cast<widgets::SceneData>(loaded.last().at(1));
  EXPECT_TRUE(data.image.isNull());
  EXPECT_TRUE(QString::fromStdString(data.image_problem.text()).contains("nowhere.png"));
  ASSERT_TRUE(data.cloud);
  EXPECT_EQ(data.cloud->size(), 2U);
}

}  // namespace
}  // namespace lvcalib::widgets::scene_data_test
