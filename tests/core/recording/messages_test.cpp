// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/messages.h"

#include <algorithm>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/bag_writer.h"

namespace lvcalib {
namespace {

using test::Wire;
using ::testing::HasSubstr;

constexpr std::int64_t kStamp = 1'700'000'001'250'000'000;

Topic topic_of(const std::string& type, Wire wire) {
  Topic topic;
  topic.name = "/topic";
  topic.type = type;
  topic.encoding = wire == Wire::kRos1 ? "ros1" : "cdr";
  return topic;
}

// Points laid out as a driver might: appends values in either byte order.
class PointBytes {
 public:
  explicit PointBytes(bool big_endian) : big_(big_endian) {}
  template <class T>
  PointBytes& put(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (big_) std::reverse(bytes.begin(), bytes.end());
    out += bytes;
    return *this;
  }
  std::string out;

 private:
  bool big_;
};

class EveryWire : public ::testing::TestWithParam<Wire> {};
INSTANTIATE_TEST_SUITE_P(Wires, EveryWire,
                         ::testing::Values(Wire::kRos1, Wire::kCdrLittle, Wire::kCdrBig),
                         [](const auto& info) {
                           return info.param == Wire::kRos1        ? "ros1"
                                  : info.param == Wire::kCdrLittle ? "cdr_little"
                                                                   : "cdr_big";
                         });

TEST_P(EveryWire, PointCloud2OfEitherByteOrderAndPaddedRows) {
  for (const bool big : {false, true}) {
    test::CloudSpec spec;
    spec.stamp_ns = kStamp;
    spec.height = 2;
    spec.width = 3;
    spec.big_endian = big;
    // Velodyne's names, in an order of their own, with gaps.
    spec.fields = {{"ring", 0, 4}, {"x", 4, 7},          {"y", 8, 7},
                   {"z", 12, 7},   {"intensity", 16, 7}, {"time", 20, 7}};
    spec.point_step = 26;
    spec.row_step = 3 * 26 + 5;
    PointBytes points(big);
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 3; ++column) {
        const auto i = static_cast<float>(3 * row + column);
        points.put(static_cast<std::uint16_t>(row)).put(std::uint16_t{0xffff});
        points.put(1.0F + i).put(-2.0F * i).put(0.5F).put(10.0F * i).put(0.01F * i);
        points.put(std::uint16_t{0xabcd});
      }
      points.out += "gap!!";
    }
    spec.data = points.out;
    const Topic topic = topic_of("sensor_msgs/PointCloud2", GetParam());
    const auto message = decode_cloud(topic, test::point_cloud2(GetParam(), spec));
    ASSERT_TRUE(message.ok()) << message.error().text();
    EXPECT_EQ(message->stamp_ns, kStamp);
    EXPECT_EQ(message->frame, "lidar");
    const Cloud& cloud = message->cloud;
    ASSERT_EQ(cloud.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
      const auto f = static_cast<float>(i);
      EXPECT_EQ(cloud.points_m[i], Eigen::Vector3f(1.0F + f, -2.0F * f, 0.5F));
      EXPECT_EQ(cloud.intensity[i], 10.0F * f);
      EXPECT_NEAR(cloud.time_s[i], 0.01F * f, 1e-7);
      EXPECT_EQ(cloud.line[i], i / 3);
    }
  }
}

TEST_P(EveryWire, PointCloud2OfOtherDrivers) {
  // Ouster: nanoseconds in 32 bits, reflectivity in 16 bits beside an intensity; no return is 0 0
  // 0.
  test::CloudSpec ouster;
  ouster.width = 3;
  ouster.fields = {{"x", 0, 7},    {"y", 4, 7}, {"z", 8, 7}, {"t", 12, 6}, {"reflectivity", 16, 4},
                   {"ring", 18, 2}};
  ouster.point_step = 20;
  PointBytes points(false);
  points.put(1.0F).put(2.0F).put(3.0F).put(std::uint32_t{0}).put(std::uint16_t{300});
  points.put(std::uint8_t{7}).put(std::uint8_t{0});
  points.put(0.0F).put(0.0F).put(0.0F).put(std::uint32_t{1}).put(std::uint16_t{0});
  points.put(std::uint8_t{7}).put(std::uint8_t{0});
  points.put(4.0F).put(5.0F).put(6.0F).put(std::uint32_t{50'000'000}).put(std::uint16_t{65535});
  points.put(std::uint8_t{9}).put(std::uint8_t{0});
  ouster.data = points.out;
  const Topic topic = topic_of("sensor_msgs/PointCloud2", GetParam());
  const auto message = decode_cloud(topic, test::point_cloud2(GetParam(), ouster));
  ASSERT_TRUE(message.ok()) << message.error().text();
  ASSERT_EQ(message->cloud.size(), 2U);
  EXPECT_EQ(message->cloud.dropped, 1U);
  EXPECT_EQ(message->cloud.intensity[1], 65535.0F);
  EXPECT_NEAR(message->cloud.time_s[1], 0.05, 1e-6);
  EXPECT_EQ(message->cloud.line[1], 9);

  // Hesai: times since 1970 as double.
  test::CloudSpec hesai;
  hesai.width = 2;
  hesai.fields = {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}, {"timestamp", 16, 8}};
  hesai.point_step = 24;
  PointBytes more(false);
  more.put(1.0F).put(0.0F).put(0.0F).put(0.0F).put(1.7e9);
  more.put(2.0F).put(0.0F).put(0.0F).put(0.0F).put(1.7e9 + 0.0625);
  hesai.data = more.out;
  const auto second = decode_cloud(topic, test::point_cloud2(GetParam(), hesai));
  ASSERT_TRUE(second.ok()) << second.error().text();
  EXPECT_FALSE(second->cloud.has_intensity());
  EXPECT_NEAR(second->cloud.time_s[1], 0.0625, 1e-6);
}

TEST_P(EveryWire, LivoxOfBothDrivers) {
  const std::vector<test::LivoxPoint> points = {{0, 1.0F, 2.0F, 3.0F, 50, 16, 0},
                                                {0, 0.0F, 0.0F, 0.0F, 0, 0, 1},
                                                {99'000'000, 4.0F, 5.0F, 6.0F, 255, 16, 5}};
  for (const char* type : {"livox_ros_driver/CustomMsg", "livox_ros_driver2/CustomMsg"}) {
    const auto message =
        decode_cloud(topic_of(type, GetParam()), test::livox_custom(GetParam(), kStamp, points));
    ASSERT_TRUE(message.ok()) << message.error().text();
    EXPECT_EQ(message->stamp_ns, kStamp);
    const Cloud& cloud = message->cloud;
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.points_m[1], Eigen::Vector3f(4.0F, 5.0F, 6.0F));
    EXPECT_EQ(cloud.intensity[1], 255.0F);
    EXPECT_EQ(cloud.line[1], 5);
    EXPECT_NEAR(cloud.time_s[1], 0.099, 1e-6);
  }
}

TEST_P(EveryWire, ImageAndCompressedImage) {
  test::ImageSpec spec{kStamp, 4, 2, "mono16", true, 10, std::string(20, 'p')};
  const auto image = decode_image(topic_of("sensor_msgs/Image", GetParam()),
                                  test::image_message(GetParam(), spec));
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->width_px, 4);
  EXPECT_EQ(image->height_px, 2);
  EXPECT_EQ(image->step, 10U);
  EXPECT_TRUE(image->big_endian);
  EXPECT_EQ(image->stamp_ns, kStamp);
  EXPECT_EQ(image->data.size(), 20U);
  const std::string jpeg(
      "\xFF\xD8\xFF\xE0\0\x04zz\xFF\xC0\0\x0B\x08\x01\xE0\x02\x80\x01\x01\x11\0"
      "\xFF\xD9",
      23);
  const auto packed =
      decode_image(topic_of("sensor_msgs/CompressedImage", GetParam()),
                   test::compressed_image(GetParam(), kStamp, "rgb8; jpeg compressed bgr8", jpeg));
  ASSERT_TRUE(packed.ok()) << packed.error().text();
  EXPECT_EQ(packed->encoding, "jpeg");
  EXPECT_EQ(packed->width_px, 640);
  EXPECT_TRUE(packed->compressed);
}

TEST_P(EveryWire, CameraInfoOfEveryModel) {
  const Topic topic = topic_of("sensor_msgs/CameraInfo", GetParam());
  test::CameraInfoSpec spec;
  spec.stamp_ns = kStamp;
  spec.width = 640;
  spec.height = 480;
  const double k[9] = {500, 0, 320, 0, 510, 240, 0, 0, 1};
  const double p[12] = {450, 0, 310, 0, 0, 460, 230, 0, 0, 0, 1, 0};
  std::copy(k, k + 9, spec.k);
  std::copy(p, p + 12, spec.p);
  const struct {
    const char* name;
    DistortionModel model;
    std::vector<double> d;
  } models[] = {
      {"plumb_bob", DistortionModel::kPlumbBob, {0.1, -0.2, 0.001, 0.002, 0.3}},
      {"plumb_bob", DistortionModel::kPlumbBob, {0.1, -0.2, 0.001, 0.002}},
      {"rational_polynomial", DistortionModel::kRationalPolynomial, {1, 2, 3, 4, 5, 6, 7, 8}},
      {"equidistant", DistortionModel::kEquidistant, {0.01, 0.02, 0.03, 0.04}},
      {"", DistortionModel::kPlumbBob, {}}};
  for (const auto& m : models) {
    spec.model = m.name;
    spec.d = m.d;
    const auto info = decode_camera_info(topic, test::camera_info(GetParam(), spec), false);
    ASSERT_TRUE(info.ok()) << info.error().text();
    EXPECT_EQ(info->camera.model, m.model);
    EXPECT_EQ(info->camera.fx, 500);
    EXPECT_EQ(info->camera.fy, 510);
    EXPECT_EQ(info->camera.cx, 320);
    EXPECT_EQ(info->camera.cy, 240);
    EXPECT_EQ(info->camera.width_px, 640);
    for (std::size_t i = 0; i < m.d.size(); ++i) {
      EXPECT_EQ(info->camera.distortion[static_cast<Eigen::Index>(i)], m.d[i]);
    }
    const auto rectified = decode_camera_info(topic, test::camera_info(GetParam(), spec), true);
    ASSERT_TRUE(rectified.ok());
    EXPECT_EQ(rectified->camera.fx, 450);
    EXPECT_EQ(rectified->camera.cy, 230);
    EXPECT_TRUE(rectified->camera.distortion.isZero());
  }
  // A part of the sensor, two by two pixels put together.
  spec.model = "plumb_bob";
  spec.d.assign(5, 0.0);
  spec.binning = 2;
  spec.roi[0] = 100;
  spec.roi[1] = 40;
  spec.roi[2] = 400;
  spec.roi[3] = 500;
  const auto part = decode_camera_info(topic, test::camera_info(GetParam(), spec), false);
  ASSERT_TRUE(part.ok());
  EXPECT_EQ(part->camera.width_px, 250);
  EXPECT_EQ(part->camera.height_px, 200);
  EXPECT_EQ(part->camera.fx, 250);
  // The pixels at 2n and 2n + 1 become pixel n.
  EXPECT_EQ(part->camera.cx, (320.0 - 100.0 + 0.5) / 2.0 - 0.5);

  spec.model = "omnidirectional";
  const auto unknown = decode_camera_info(topic, test::camera_info(GetParam(), spec), false);
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.error().text(), HasSubstr("omnidirectional"));
  spec.model = "plumb_bob";
  spec.k[0] = 0.0;
  const auto none = decode_camera_info(topic, test::camera_info(GetParam(), spec), false);
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().text(), HasSubstr("not calibrated"));
}

TEST_P(EveryWire, MessagesCutOffAnywhereAreErrors) {
  test::CloudSpec cloud;
  cloud.width = 2;
  cloud.fields = {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}};
  cloud.point_step = 12;
  cloud.data = std::string(24, '\x3f');
  const test::ImageSpec image{kStamp, 2, 2, "mono8", false, 2, "abcd"};
  test::CameraInfoSpec camera;
  camera.d.assign(5, 0.0);
  const std::vector<std::pair<std::string, std::string>> messages = {
      {"sensor_msgs/PointCloud2", test::point_cloud2(GetParam(), cloud)},
      {"livox_ros_driver/CustomMsg",
       test::livox_custom(GetParam(), kStamp, {{0, 1, 2, 3, 4, 5, 6}, {1, 1, 2, 3, 4, 5, 6}})},
      {"sensor_msgs/Image", test::image_message(GetParam(), image)},
      {"sensor_msgs/CameraInfo", test::camera_info(GetParam(), camera)}};
  for (const auto& [type, bytes] : messages) {
    const Topic topic = topic_of(type, GetParam());
    for (std::size_t cut = 0; cut < bytes.size() - 1; ++cut) {
      const std::string part = bytes.substr(0, cut);
      const bool is_cloud = message_kind(type) == MessageKind::kCloud;
      const bool ok = is_cloud ? decode_cloud(topic, part).ok()
                      : message_kind(type) == MessageKind::kImage
                          ? decode_image(topic, part).ok()
                          : decode_camera_info(topic, part, false).ok();
      EXPECT_FALSE(ok) << type << " cut to " << cut << " of " << bytes.size();
    }
  }
}

TEST(Messages, CloudsThatContradictThemselvesAreRefused) {
  const Topic topic = topic_of("sensor_msgs/PointCloud2", Wire::kRos1);
  test::CloudSpec good;
  good.width = 2;
  good.fields = {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}};
  good.point_step = 12;
  good.data = std::string(24, '\x3f');
  ASSERT_TRUE(decode_cloud(topic, test::point_cloud2(Wire::kRos1, good)).ok());
  const auto refused = [&](const test::CloudSpec& spec, const std::string& why) {
    const auto cloud = decode_cloud(topic, test::point_cloud2(Wire::kRos1, spec));
    ASSERT_FALSE(cloud.ok()) << why;
    EXPECT_THAT(cloud.error().text(), HasSubstr(why));
  };
  test::CloudSpec bad = good;
  bad.width = 0xffffffff;
  refused(bad, "claims");
  bad = good;
  bad.height = 0xffffffff;
  refused(bad, "claims");
  bad = good;
  bad.fields[2].offset = 9;
  refused(bad, "outside of a point");
  bad.fields[2].offset = 0xfffffffe;
  refused(bad, "outside of a point");
  bad = good;
  bad.fields[1].datatype = 99;
  refused(bad, "unknown type");
  bad = good;
  bad.fields.pop_back();
  refused(bad, "'z'");
  bad = good;
  bad.point_step = 0;
  refused(bad, "outside of a point");
  bad = good;
  bad.width = 0;
  bad.data.clear();
  refused(bad, "no points");
  bad = good;
  bad.data = std::string(24, '\xff');  // NaN
  refused(bad, "none of its");
}

TEST(Messages, ImagesThatContradictThemselvesAreRefused) {
  const Topic topic = topic_of("sensor_msgs/Image", Wire::kCdrLittle);
  const auto refused = [&](const test::ImageSpec& spec, const std::string& why) {
    const auto image = decode_image(topic, test::image_message(Wire::kCdrLittle, spec));
    ASSERT_FALSE(image.ok()) << why;
    EXPECT_THAT(image.error().text(), HasSubstr(why));
  };
  const std::string data(12, 'x');
  refused({0, 4, 4, "mono8", false, 4, data}, "holds 12 bytes");
  refused({0, 4, 3, "mono8", false, 3, data}, "claims");
  refused({0, 0, 3, "mono8", false, 4, data}, "claims");
  refused({0, 0xffffffff, 0xffffffff, "mono8", false, 0xffffffff, data}, "claims");
  refused({0, 2, 2, "32FC1", false, 8, data}, "'32FC1'");
  const Topic packed = topic_of("sensor_msgs/CompressedImage", Wire::kCdrLittle);
  const auto depth = decode_image(
      packed, test::compressed_image(Wire::kCdrLittle, 0, "16UC1; compressedDepth", data));
  ASSERT_FALSE(depth.ok());
  EXPECT_THAT(depth.error().text(), HasSubstr("compressedDepth"));
}

TEST(Messages, RawPacketsAreNamedWithTheirDriver) {
  EXPECT_EQ(message_kind("velodyne_msgs/VelodyneScan"), MessageKind::kRawPackets);
  EXPECT_THAT(converter_of("velodyne_msgs/VelodyneScan"), HasSubstr("velodyne_pointcloud"));
  EXPECT_EQ(message_kind("theora_image_transport/Packet"), MessageKind::kRawVideo);
  EXPECT_EQ(message_kind("std_msgs/String"), MessageKind::kOther);
  EXPECT_TRUE(converter_of("sensor_msgs/PointCloud2").empty());
}

TEST(Messages, OtherSerializationsAreNamed) {
  Topic topic = topic_of("sensor_msgs/PointCloud2", Wire::kRos1);
  topic.encoding = "protobuf";
  const auto cloud = decode_cloud(topic, "anything");
  ASSERT_FALSE(cloud.ok());
  EXPECT_THAT(cloud.error().text(), HasSubstr("protobuf"));
  topic.encoding = "cdr";
  EXPECT_FALSE(decode_cloud(topic, "\x12\x34\x56\x78").ok());
  EXPECT_FALSE(decode_cloud(topic, "").ok());
}

}  // namespace
}  // namespace lvcalib
