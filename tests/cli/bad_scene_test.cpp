// SPDX-License-Identifier: GPL-3.0-or-later
// Images and clouds that are there, but damaged or unfit.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "cli/bad_input.h"
#include "cloud/cloud.h"
#include "support/image_files.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;

using Spoil = std::function<void(const fs::path&)>;
constexpr const char* kSceneImage = "scenes/B/image.png";
constexpr const char* kSceneCloud = "scenes/B/cloud.pcd";

Spoil write(const char* name, const std::string& content) {
  return [=](const fs::path& dataset) { write_file(dataset / name, content); };
}

// Rewrites a file's bytes.
Spoil change(const char* name, const std::function<std::string(std::string)>& changed) {
  return [=](const fs::path& dataset) {
    write_file(dataset / name, changed(read_file(dataset / name)));
  };
}

std::string first_half(const std::string& bytes) {
  return bytes.substr(0, bytes.size() / 2);
}

// The check sum of PNG chunks (ISO 3309).
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

// After the 8-byte signature the first chunk's length, type, width, height, five bytes and sum.
std::string claiming_huge_size(std::string png) {
  for (const std::size_t at : {16U, 20U}) png.replace(at, 4, std::string("\x7f\xff\xff\xff", 4));
  const std::uint32_t sum = crc32(std::string_view(png).substr(12, 17));
  for (std::size_t k = 0; k < 4; ++k) png[29 + k] = static_cast<char>(sum >> (24U - 8U * k));
  return png;
}

// Damages the compressed pixels, not the header.
std::string damaged(std::string bytes) {
  for (std::size_t i = 200; i < bytes.size(); i += 50) bytes[i] = static_cast<char>(~bytes[i]);
  return bytes;
}

Spoil resize_image(double factor) {
  return [=](const fs::path& dataset) {
    cv::Mat image = test::read_pixels(dataset / kSceneImage);
    cv::resize(image, image, {}, factor, factor);
    fs::remove(dataset / kSceneImage);
    test::write_png(dataset / kSceneImage, image);
  };
}

std::vector<BadInput> images() {
  return {
      {"ImageOfOtherSize",
       resize_image(0.5),
       3,
       {"B/image.png: ", "512 × 384", "1024 × 768", "intrinsics"}},
      {"EmptyImage", write(kSceneImage, ""), 3, {"B/image.png: "}},
      {"TextAsImage", write(kSceneImage, "this is no image\n"), 3, {"B/image.png: ", "expected"}},
      {"TruncatedImage", change(kSceneImage, first_half), 3, {"B/image.png: "}},
      {"DamagedImage", change(kSceneImage, damaged), 3, {"B/image.png: "}},
      {"HeaderOnlyImage",
       change(kSceneImage, [](const std::string& png) { return png.substr(0, 33); }),
       3,
       {"B/image.png: "}},
      {"HugeImage",
       change(kSceneImage, claiming_huge_size),
       3,
       {"B/image.png: ", "claims 2147483647 × 2147483647 pixels; expected"}},
  };
}

std::string pcd_header(const std::string& fields, std::size_t points, const std::string& data) {
  const std::size_t count = static_cast<std::size_t>(std::count(fields.begin(), fields.end(), ' '));
  std::string out = "VERSION 0.7\nFIELDS " + fields + "\nSIZE";
  for (std::size_t i = 0; i <= count; ++i) out += " 4";
  out += "\nTYPE";
  for (std::size_t i = 0; i <= count; ++i) out += " F";
  out += "\nWIDTH " + std::to_string(points) + "\nHEIGHT 1\nPOINTS " + std::to_string(points);
  return out + "\nDATA " + data + "\n";
}

std::string binary_floats(std::size_t count, float value) {
  const auto bits = std::bit_cast<std::array<char, 4>>(value);
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out.append(bits.data(), bits.size());
  return out;
}

void drop_intensity(const fs::path& dataset) {
  auto cloud = read_cloud(dataset / kSceneCloud);
  ASSERT_TRUE(cloud.ok());
  cloud->intensity.clear();
  fs::remove(dataset / kSceneCloud);
  ASSERT_TRUE(write_pcd(dataset / kSceneCloud, *cloud).ok());
}

TEST(NoIntensityInOneScene, LeavesItsPlaneAndCorners) {
  const SpoiledRun run({"NoIntensityInOneScene", drop_intensity});
  EXPECT_EQ(run.outcome().status, 0) << run.outcome().err;
  EXPECT_THAT(lines_with(run.outcome().err, "lvcalib: warning: "),
              ::testing::Contains(::testing::AllOf(::testing::HasSubstr("intensity is missing"),
                                                   ::testing::HasSubstr("scene B"))));
}

std::string with_other_data(std::string bytes) {
  const auto at = bytes.find("DATA binary");
  return bytes.replace(at, 11, "DATA binray");
}

std::vector<BadInput> clouds() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::string where = "B/cloud.pcd: ";
  return {
      {"EmptyCloud", write(kSceneCloud, ""), 3, {where}},
      {"NoPoints",
       write(kSceneCloud, pcd_header("x y z intensity", 0, "binary")),
       3,
       {where, "points"}},
      {"AllNan",
       write(kSceneCloud,
             pcd_header("x y z intensity", 1000, "binary") + binary_floats(4000, kNan)),
       3,
       {where, "1000", "finite"}},
      {"AllInfinite",
       write(kSceneCloud,
             pcd_header("x y z intensity", 1000, "binary") + binary_floats(4000, HUGE_VALF)),
       3,
       {where, "1000", "finite"}},
      {"TruncatedCloud", change(kSceneCloud, first_half), 3, {where, "truncated", "points"}},
      {"ManyClaimedPoints",
       write(kSceneCloud,
             pcd_header("x y z intensity", 100'000'000, "binary") + binary_floats(400, 1)),
       3,
       {where, "100000000", "100"}},
      {"ManyClaimedTextPoints",
       write(kSceneCloud,
             pcd_header("x y z intensity", 100'000'000, "ascii") + "1 2 3 4\n5 6 7 8\n"),
       3,
       {where, "100000000", "2"}},
      {"ManyClaimedPackedPoints",
       write(kSceneCloud, pcd_header("x y z intensity", 100'000'000, "binary_compressed") +
                              std::string("\x08\x00\x00\x00\x00\x10\x5e\x5f", 8) + "12345678"),
       3,
       {where, "100000000"}},
      {"WrongDataKeyword",
       change(kSceneCloud, with_other_data),
       3,
       {where, "DATA 'binray' is not known, expected ascii, binary or binary_compressed"}},
      {"TextAsCloud", write(kSceneCloud, "Dear diary,\ntoday no cloud was seen.\n"), 3, {where}},
      {"WordsAsNumbers",
       write(kSceneCloud, pcd_header("x y z intensity", 2, "ascii") + "1 2 3 4\n1 two 3 4\n"),
       3,
       {where, "two"}},
      {"NoCoordinates",
       write(kSceneCloud, pcd_header("a b c intensity", 2, "ascii") + "1 2 3 4\n1 2 3 4\n"),
       3,
       {where, "x"}},
  };
}

std::vector<BadInput> failing() {
  std::vector<BadInput> inputs = images();
  for (const BadInput& input : clouds()) inputs.push_back(input);
  return inputs;
}

class BadScene : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadScene, IsNamedInOneClearError) {
  SpoiledRun(GetParam()).expect_as_described();
}

INSTANTIATE_TEST_SUITE_P(Dataset, BadScene, ::testing::ValuesIn(failing()),
                         [](const auto& info) { return info.param.name; });

// A scene whose files are sound but show no board costs that scene, not the calibration.
std::vector<BadInput> costing_a_scene() {
  return {
      {"FewPoints",
       write(kSceneCloud, pcd_header("x y z intensity", 2, "ascii") + "1 2 3 4\n1 2 2 4\n"),
       0,
       {"scene B is not used", "not found in the cloud"}},
      {"GreyImage",
       [](const fs::path& dataset) {
         const cv::Mat grey(768, 1024, CV_8U, cv::Scalar(128));
         fs::remove(dataset / kSceneImage);
         test::write_png(dataset / kSceneImage, grey);
       },
       0,
       {"scene B is not used", "B/image.png: no tags in the image"}},
  };
}

BadInput skipping(BadInput input) {
  input.arguments = {"--skip-unreadable"};
  return input;
}

TEST(SkipUnreadable, LeavesTheSceneOutWithAWarning) {
  const SpoiledRun run(skipping({"Truncated", change(kSceneCloud, first_half)}));
  EXPECT_EQ(run.outcome().status, 0) << run.outcome().err;
  EXPECT_THAT(lines_with(run.outcome().err, "lvcalib: warning: "),
              ::testing::Contains(::testing::AllOf(::testing::HasSubstr("scene B is not used"),
                                                   ::testing::HasSubstr("truncated"))));
}

class UselessScene : public ::testing::TestWithParam<BadInput> {};

TEST_P(UselessScene, IsLeftOutWithAWarning) {
  const SpoiledRun run(GetParam());
  EXPECT_EQ(run.outcome().status, 0) << run.outcome().err;
  const auto warnings = lines_with(run.outcome().err, "lvcalib: warning: ");
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(warnings, ::testing::Contains(AllOf(HasSubstr(GetParam().message[0]),
                                                  HasSubstr(GetParam().message[1]))))
      << run.outcome().err;
}

INSTANTIATE_TEST_SUITE_P(Dataset, UselessScene, ::testing::ValuesIn(costing_a_scene()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace lvcalib::testing
