// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "detection/board_view.h"
#include "detection/color_image.h"
#include "support/rendered_board.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("lvcalib_image_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  static std::string bytes_of(const std::string& file) {
    std::ostringstream out;
    out << std::ifstream(file, std::ios::binary).rdbuf();
    return out.str();
  }

  fs::path folder_;
};

cv::Mat ramp(int type) {
  cv::Mat mat(20, 30, type);
  const bool wide = mat.depth() == CV_16U;
  for (int y = 0; y < mat.rows; ++y) {
    for (int x = 0; x < mat.cols; ++x) {
      for (int c = 0; c < mat.channels(); ++c) {
        const int value = 8 * x + y + (c == 3 ? 100 : 0);
        if (wide) {
          mat.ptr<unsigned short>(y)[x * mat.channels() + c] =
              static_cast<unsigned short>(257 * value + 64);
        } else {
          mat.ptr<unsigned char>(y)[x * mat.channels() + c] = static_cast<unsigned char>(value);
        }
      }
    }
  }
  return mat;
}

TEST_F(ImageFile, ReadsEveryDepthAndNumberOfChannels) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4}) {
    for (const char* format : {"png", "tiff", "bmp"}) {
      if (std::string(format) == "bmp" && type != CV_8UC1 && type != CV_8UC3) continue;
      const std::string file = path(std::string("ramp.") + format);
      ASSERT_TRUE(cv::imwrite(file, ramp(type)));
      const auto image = read_image(file);
      ASSERT_TRUE(image.ok()) << image.error().text();
      EXPECT_EQ(image->width_px, 30);
      EXPECT_EQ(image->height_px, 20);
      const double fine = CV_MAT_DEPTH(type) == CV_16U ? 64.0 / 257.0 : 0.0;
      EXPECT_NEAR(image->at(7, 3), 8 * 7 + 3 + fine, 1e-3) << format << " type " << type;
    }
  }
}

TEST_F(ImageFile, AJpegHasOpenCvsColours) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    cv::Mat mat = ramp(type);
    if (type == CV_8UC3) cv::multiply(mat, cv::Scalar(0.3, 1.0, 0.7), mat);
    ASSERT_TRUE(cv::imwrite(path("ramp.jpg"), mat));
    const cv::Mat wanted = cv::imread(path("ramp.jpg"), cv::IMREAD_COLOR);
    const auto image = read_color_image(path("ramp.jpg"));
    ASSERT_TRUE(image.ok()) << image.error().text();
    for (int y = 0; y < mat.rows; ++y) {
      for (int x = 0; x < mat.cols; ++x) {
        for (int c = 0; c < 3; ++c) {
          const auto k = static_cast<std::size_t>(3 * (y * mat.cols + x) + c);
          ASSERT_EQ(image->rgb[k], wanted.at<cv::Vec3b>(y, x)[2 - c]) << x << ' ' << y;
        }
      }
    }
  }
}

TEST_F(ImageFile, WeighsColorsAsLuma) {
  ASSERT_TRUE(cv::imwrite(path("red.png"), cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 0, 200))));
  EXPECT_NEAR(read_image(path("red.png"))->at(1, 1), 0.299 * 200, 0.01);
}

// Calibration needs the sensor's own rows and columns, whatever a viewer would do.
TEST_F(ImageFile, IgnoresTheRotationThatExifAsksFor) {
  ASSERT_TRUE(cv::imwrite(path("plain.jpg"), ramp(CV_8UC1)));
  const std::string plain = bytes_of(path("plain.jpg"));
  const std::string exif(
      "\xFF\xE1\x00\x22"
      "Exif\0\0MM\0\x2A\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
      36);
  const auto image = read_image(write("turned.jpg", plain.substr(0, 2) + exif + plain.substr(2)));
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->width_px, 30);
  EXPECT_EQ(image->height_px, 20);
}

TEST_F(ImageFile, TruncatedFilesAreErrorsWithoutOutput) {
  for (const char* format : {"png", "jpg"}) {
    const std::string file = path(std::string("whole.") + format);
    ASSERT_TRUE(cv::imwrite(file, ramp(CV_8UC3)));
    const std::string whole = bytes_of(file);
    for (const double share : {0.0, 0.05, 0.3, 0.6, 0.9, 0.99}) {
      const auto length = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
      const std::string cut = write(std::string("cut.") + format, whole.substr(0, length));
      ::testing::internal::CaptureStderr();
      const auto image = read_image(cut);
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << format << " " << share;
      ASSERT_FALSE(image.ok()) << format << " " << share;
      EXPECT_EQ(image.error().kind, ErrorKind::kInput);
      EXPECT_EQ(image.error().where, cut);
    }
  }
}

TEST_F(ImageFile, FlippedBitsNeverCrash) {
  for (const char* format : {"jpg", "bmp", "tiff"}) {
    const std::string file = path(std::string("whole.") + format);
    ASSERT_TRUE(cv::imwrite(file, ramp(CV_8UC1)));
    const std::string whole = bytes_of(file);
    ::testing::internal::CaptureStderr();
    for (std::size_t i = 2; i < whole.size(); i += whole.size() / 60 + 1) {
      std::string broken = whole;
      broken[i] = static_cast<char>(~broken[i]);
      const auto image = read_image(write(std::string("broken.") + format, broken));
      if (image.ok()) {
        EXPECT_EQ(image->pixels.size(), static_cast<std::size_t>(image->width_px) *
                                            static_cast<std::size_t>(image->height_px));
      }
    }
    ::testing::internal::GetCapturedStderr();
  }
}

TEST_F(ImageFile, OtherContentIsNamedAsSuch) {
  const auto text = read_image(write("text.png", "not an image at all"));
  ASSERT_FALSE(text.ok());
  EXPECT_NE(text.error().message.text().find("expected png, jpg, bmp or tiff"), std::string::npos);
  EXPECT_FALSE(read_image(path("missing.png")).ok());
  EXPECT_FALSE(read_image(folder_).ok());
}

TEST(SharedImages, PaletteIsRead) {
  const auto data = testing::shared_data();
  if (!data) GTEST_SKIP() << "shared data not found";
  const auto image = read_image(*data / "real/vlp16-checkerboard/scenes/pose01/image.png");
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->width_px, 1920);
}

TEST_F(ImageFile, ColoursAreKeptForLookingAt) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3}) {
    cv::Mat mat = ramp(type);
    // Red where OpenCV keeps it: last of blue, green, red.
    if (mat.channels() >= 3) {
      for (int y = 0; y < mat.rows; ++y) {
        for (int x = 0; x < mat.cols; ++x) {
          if (mat.depth() == CV_8U)
            mat.ptr<unsigned char>(y)[x * mat.channels() + 2] = 250;
          else
            mat.ptr<unsigned short>(y)[x * mat.channels() + 2] = 257 * 250;
        }
      }
    }
    cv::imwrite(path("color.png"), mat);
    const auto image = read_color_image(path("color.png"));
    ASSERT_TRUE(image.ok()) << image.error().text();
    ASSERT_EQ(image->width_px, 30);
    ASSERT_EQ(image->rgb.size(), 3U * 30U * 20U);
    const std::uint8_t* pixel = image->rgb.data() + 3 * (5 * 30 + 7);
    EXPECT_EQ(pixel[0], mat.channels() >= 3 ? 250 : 61) << type;
    EXPECT_EQ(pixel[1], 61) << type;
    EXPECT_EQ(pixel[2], 61) << type;
  }
  EXPECT_FALSE(read_color_image(path("none.png")).ok());
  EXPECT_FALSE(read_color_image(write("text.png", "no image")).ok());
}

}  // namespace
}  // namespace lvcalib
