// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <opencv2/aruco/dictionary.hpp>

#include "target/target.h"

namespace lvcalib {
namespace {

std::vector<TagPattern> read_family(apriltag_family_t* (*create)(),
                                    void (*destroy)(apriltag_family_t*)) {
  apriltag_family_t* family = create();
  std::vector<TagPattern> patterns;
  const int width = family->width_at_border - 2;
  const unsigned bits = family->nbits;
  for (unsigned id = 0; id < family->ncodes; ++id) {
    TagPattern pattern{width, std::vector<bool>(static_cast<std::size_t>(width * width), false)};
    for (unsigned i = 0; i < bits; ++i) {
      // Bit positions count from the outer edge of a one-bit border.
      const unsigned column = family->bit_x[i] - 1U;
      const unsigned row = family->bit_y[i] - 1U;
      pattern.white[row * static_cast<unsigned>(width) + column] =
          ((family->codes[id] >> (bits - i - 1U)) & 1U) != 0;
    }
    patterns.push_back(std::move(pattern));
  }
  destroy(family);
  return patterns;
}

const std::vector<std::pair<std::string, int>>& dictionary_numbers() {
  using namespace cv::aruco;
  static const std::vector<std::pair<std::string, int>> all = {
      {"DICT_4X4_50", DICT_4X4_50},
      {"DICT_4X4_100", DICT_4X4_100},
      {"DICT_4X4_250", DICT_4X4_250},
      {"DICT_4X4_1000", DICT_4X4_1000},
      {"DICT_5X5_50", DICT_5X5_50},
      {"DICT_5X5_100", DICT_5X5_100},
      {"DICT_5X5_250", DICT_5X5_250},
      {"DICT_5X5_1000", DICT_5X5_1000},
      {"DICT_6X6_50", DICT_6X6_50},
      {"DICT_6X6_100", DICT_6X6_100},
      {"DICT_6X6_250", DICT_6X6_250},
      {"DICT_6X6_1000", DICT_6X6_1000},
      {"DICT_7X7_50", DICT_7X7_50},
      {"DICT_7X7_100", DICT_7X7_100},
      {"DICT_7X7_250", DICT_7X7_250},
      {"DICT_7X7_1000", DICT_7X7_1000},
      {"DICT_ARUCO_ORIGINAL", DICT_ARUCO_ORIGINAL},
      {"DICT_APRILTAG_16h5", DICT_APRILTAG_16h5},
      {"DICT_APRILTAG_25h9", DICT_APRILTAG_25h9},
      {"DICT_APRILTAG_36h10", DICT_APRILTAG_36h10},
      {"DICT_APRILTAG_36h11", DICT_APRILTAG_36h11}};
  return all;
}

std::vector<TagPattern> read_dictionary(int number) {
  const cv::Ptr<cv::aruco::Dictionary> dictionary = cv::aruco::getPredefinedDictionary(number);
  const int width = dictionary->markerSize;
  std::vector<TagPattern> patterns;
  for (int id = 0; id < dictionary->bytesList.rows; ++id) {
    const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(
        dictionary->bytesList.rowRange(id, id + 1), width);
    TagPattern pattern{width, {}};
    for (int row = 0; row < width; ++row) {
      for (int column = 0; column < width; ++column)
        pattern.white.push_back(bits.at<unsigned char>(row, column) != 0);
    }
    patterns.push_back(std::move(pattern));
  }
  return patterns;
}

// As the families: built on first use; constant afterwards.
const std::vector<TagPattern>* dictionary_patterns(const std::string& name) {
  static const std::map<std::string, std::vector<TagPattern>> dictionaries = [] {
    std::map<std::string, std::vector<TagPattern>> all;
    for (const auto& [entry, number] : dictionary_numbers()) all[entry] = read_dictionary(number);
    return all;
  }();
  const auto found = dictionaries.find(name);
  return found == dictionaries.end() ? nullptr : &found->second;
}

// Built on first use; constant afterwards.
const std::vector<TagPattern>* family_patterns(const std::string& name) {
  static const std::map<std::string, std::vector<TagPattern>> families = [] {
    std::map<std::string, std::vector<TagPattern>> all;
    all["tag36h11"] = read_family(tag36h11_create, tag36h11_destroy);
    all["tag36h10"] = read_family(tag36h10_create, tag36h10_destroy);
    all["tag25h9"] = read_family(tag25h9_create, tag25h9_destroy);
    all["tag16h5"] = read_family(tag16h5_create, tag16h5_destroy);
    return all;
  }();
  if (is_marker_dictionary(name)) return dictionary_patterns(name);
  const auto found = families.find(name);
  return found == families.end() ? nullptr : &found->second;
}

}  // namespace

const TagPattern* tag_pattern(const std::string& family, int id) {
  const auto* patterns = family_patterns(family);
  if (patterns == nullptr || id < 0 || static_cast<std::size_t>(id) >= patterns->size()) {
    return nullptr;
  }
  return &(*patterns)[static_cast<std::size_t>(id)];
}

const std::vector<std::string>& marker_dictionaries() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& [name, number] : dictionary_numbers()) out.push_back(name);
    return out;
  }();
  return names;
}

bool is_marker_dictionary(const std::string& family) {
  const auto& names = marker_dictionaries();
  return std::find(names.begin(), names.end(), family) != names.end();
}

int tag_family_size(const std::string& family) {
  const auto* patterns = family_patterns(family);
  return patterns == nullptr ? 0 : static_cast<int>(patterns->size());
}

}  // namespace lvcalib
