// SPDX-License-Identifier: BSD-3-Clause
#include "recording/file_pairs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <system_error>

#include "base/file_io.h"
#include "base/image_header.h"
#include "base/text.h"
#include "base/yaml_file.h"
#include "recording/foreign_cameras.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

using Paths = std::vector<fs::path>;

constexpr std::size_t kMostNamed = 40;  // Of files without a partner: a screen full.
constexpr std::size_t kMostText = 16U << 20U;
constexpr std::size_t kMostImage = 256U << 20U;

const std::set<std::string> kImages = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
const std::set<std::string> kClouds = {".pcd", ".ply", ".bin"};
const std::set<std::string> kRecordings = {".bag", ".mcap"};

std::string extension_of(const fs::path& path) {
  std::string out = path.extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// The files of a folder with one of these extensions, by their names.
Paths files_in(const fs::path& folder, const std::set<std::string>& extensions) {
  Paths out;
  std::error_code code;
  for (fs::directory_iterator i(folder, code), end; !code && i != end; i.increment(code)) {
    const std::string name = i->path().filename().string();
    std::error_code other;
    if (name.starts_with(".") || !i->is_regular_file(other)) continue;
    if (extensions.contains(extension_of(i->path()))) out.push_back(i->path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

Paths folders_in(const fs::path& folder) {
  Paths out;
  std::error_code code;
  for (fs::directory_iterator i(folder, code), end; !code && i != end; i.increment(code)) {
    std::error_code other;
    if (i->is_directory(other) && !i->path().filename().string().starts_with("."))
      out.push_back(i->path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

bool is_file(const fs::path& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

std::string stem_of(const fs::path& path) {
  return path.stem().string();
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// The last number in a name, without leading zeros; empty if there is none.
std::string number_in(const std::string& stem) {
  const auto last = std::find_if(stem.rbegin(), stem.rend(), is_digit);
  if (last == stem.rend()) return {};
  const auto first = std::find_if_not(last, stem.rend(), is_digit);
  const std::string digits(first.base(), last.base());
  const std::size_t begin = digits.find_first_not_of('0');
  return begin == std::string::npos ? "0" : digits.substr(begin);
}

using Key = std::function<std::string(const fs::path&)>;

// By key; of several files with one key the first counts.
std::map<std::string, fs::path> by_key(const Paths& files, const Key& key) {
  std::map<std::string, fs::path> out;
  for (const fs::path& file : files) {
    const std::string k = key(file);
    if (!k.empty()) out.emplace(k, file);
  }
  return out;
}

std::vector<FilePair> pairs_by_key(const Paths& images, const Paths& clouds, const Key& image_key,
                                   const Key& cloud_key) {
  const auto cloud_of = by_key(clouds, cloud_key);
  std::vector<FilePair> out;
  for (const auto& [key, image] : by_key(images, image_key)) {
    const auto found = cloud_of.find(key);
    if (found != cloud_of.end()) out.push_back({stem_of(image), image, found->second, {}, {}});
  }
  std::sort(out.begin(), out.end(),
            [](const FilePair& a, const FilePair& b) { return a.image < b.image; });
  return out;
}

struct TimedFile {
  double time_s = 0.0;
  fs::path path;
};

// All of them, or nothing: a name that is no time makes the others doubtful.
std::optional<std::vector<TimedFile>> timed(const Paths& files, double offset_s) {
  std::vector<TimedFile> out;
  for (const fs::path& file : files) {
    const auto time = time_of_name(stem_of(file));
    if (!time) return std::nullopt;
    out.push_back({*time + offset_s, file});
  }
  std::sort(out.begin(), out.end(),
            [](const TimedFile& a, const TimedFile& b) { return a.time_s < b.time_s; });
  return out;
}

// Median time from file to file; infinite for fewer than two.
double usual_step_s(const std::vector<TimedFile>& files) {
  if (files.size() < 2) return std::numeric_limits<double>::infinity();
  std::vector<double> steps;
  for (std::size_t i = 1; i < files.size(); ++i)
    steps.push_back(files[i].time_s - files[i - 1].time_s);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::size_t nearest(const std::vector<TimedFile>& files, double time_s) {
  const auto after = std::lower_bound(files.begin(), files.end(), time_s,
                                      [](const TimedFile& f, double t) { return f.time_s < t; });
  if (after == files.begin()) return 0;
  if (after == files.end()) return files.size() - 1;
  const auto before = after - 1;
  const bool later = after->time_s - time_s < time_s - before->time_s;
  return static_cast<std::size_t>((later ? after : before) - files.begin());
}

// Each is the other's nearest, and near enough.
std::vector<FilePair> pairs_by_time(const std::vector<TimedFile>& images,
                                    const std::vector<TimedFile>& clouds, double most_apart_s) {
  if (most_apart_s <= 0.0) {
    const auto& fewer = images.size() < clouds.size() ? images : clouds;
    most_apart_s = 0.5 * usual_step_s(fewer);
  }
  std::vector<FilePair> out;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::size_t k = nearest(clouds, images[i].time_s);
    const double apart_s = clouds[k].time_s - images[i].time_s;
    if (nearest(images, clouds[k].time_s) != i || std::abs(apart_s) > most_apart_s) continue;
    out.push_back({stem_of(images[i].path), images[i].path, clouds[k].path, {}, apart_s});
  }
  return out;
}

void name_unmatched(const Paths& images, const Paths& clouds, PairedFiles& out) {
  std::set<fs::path> used;
  for (const FilePair& pair : out.pairs) {
    used.insert(pair.image);
    used.insert(pair.cloud);
    used.insert(pair.board_points);
  }
  std::size_t more = 0;
  const auto tell = [&](const Paths& files, const Message& what) {
    for (const fs::path& file : files) {
      if (used.contains(file)) continue;
      if (out.unmatched.size() < kMostNamed) {
        out.unmatched.push_back({file.filename().string(), what});
      } else {
        ++more;
      }
    }
  };
  tell(images, Message("no cloud belongs to it"));
  tell(clouds, Message("no image belongs to it"));
  if (more > 0) out.unmatched.push_back({{}, Message("%1 more files without a partner", more)});
}

// Width and height of an image file.
Result<ImageHeader> size_of(const fs::path& image) {
  const auto bytes = read_text_file(image, kMostImage);
  if (!bytes) return bytes.error();
  return read_image_header(*bytes);
}

void take_camera(const Result<Camera>& camera, const fs::path& from, PairedFiles& out) {
  if (camera) {
    out.camera = *camera;
    out.camera_from = from.string();
  } else {
    out.warnings.push_back(camera.error().sentence());
  }
}

// An intrinsics file of a format that the calibration reads, under one of its usual names.
void find_camera_file(const Paths& folders, PairedFiles& out) {
  for (const fs::path& folder : folders) {
    for (const char* name : {"camera.yaml", "camera_info.yaml", "ost.yaml"}) {
      if (!is_file(folder / name)) continue;
      const auto file = read_camera(folder / name);
      take_camera(file ? Result<Camera>(file->camera) : Result<Camera>(file.error()), folder / name,
                  out);
      return;  // The nearest counts, also if it cannot be read.
    }
  }
}

// ---- KITTI raw ----

struct KittiDrive {
  fs::path folder;
  std::string camera;  // "02"
};

std::optional<KittiDrive> kitti_drive(const fs::path& given) {
  fs::path place = given.filename().empty() ? given.parent_path() : given;
  KittiDrive out{place, {}};
  if (place.filename() == "data") place = place.parent_path();
  const std::string name = place.filename().string();
  if (name.starts_with("image_0")) out = {place.parent_path(), name.substr(6)};
  if (!is_folder(out.folder / "velodyne_points" / "data")) return std::nullopt;
  // Colour first: from the left camera, then from the right one; then grey.
  for (const char* number : {"02", "03", "00", "01"}) {
    if (out.camera.empty() && is_folder(out.folder / ("image_" + std::string(number)) / "data"))
      out.camera = number;
  }
  return out.camera.empty() ? std::nullopt : std::optional(out);
}

// Seconds of the day of each line "2011-09-26 13:02:25.594360375".
std::vector<double> kitti_times(const fs::path& path) {
  const auto text = read_text_file(path, kMostText);
  std::vector<double> out;
  if (!text) return out;
  std::istringstream stream(*text);
  for (std::string line; std::getline(stream, line);) {
    int hours = 0;
    int minutes = 0;
    double seconds = 0.0;
    const std::size_t space = line.find(' ');
    if (space == std::string::npos) continue;
    char first = 0;
    char second = 0;
    std::istringstream clock(line.substr(space));
    if (clock >> hours >> first >> minutes >> second >> seconds)
      out.push_back(3600.0 * hours + 60.0 * minutes + seconds);
  }
  return out;
}

PairedFiles kitti_pairs(const KittiDrive& drive) {
  PairedFiles out;
  out.layout = FileLayout::kKittiRaw;
  const fs::path image_folder = drive.folder / ("image_" + drive.camera);
  const fs::path cloud_folder = drive.folder / "velodyne_points";
  const Paths images = files_in(image_folder / "data", kImages);
  const Paths clouds = files_in(cloud_folder / "data", {".bin"});
  out.pairs = pairs_by_key(images, clouds, stem_of, stem_of);
  const auto image_times = kitti_times(image_folder / "timestamps.txt");
  const auto cloud_times = kitti_times(cloud_folder / "timestamps.txt");
  for (FilePair& pair : out.pairs) {
    const auto index = static_cast<std::size_t>(std::strtoull(pair.name.c_str(), nullptr, 10));
    if (index >= image_times.size() || index >= cloud_times.size()) continue;
    constexpr double day_s = 86400.0;  // Midnight may lie between both.
    pair.apart_s = std::remainder(cloud_times[index] - image_times[index], day_s);
  }
  name_unmatched(images, clouds, out);
  const bool rectified = drive.folder.string().find("_sync") != std::string::npos;
  for (const fs::path& folder : {drive.folder, drive.folder.parent_path()}) {
    const fs::path file = folder / "calib_cam_to_cam.txt";
    if (out.camera || !is_file(file)) continue;
    const auto text = read_text_file(file, kMostText);
    if (!text) continue;
    take_camera(camera_of_kitti(*text, drive.camera, rectified, file.string()), file, out);
  }
  return out;
}

// ---- Tools of others ----

bool is_acfr(const fs::path& folder) {
  if (!is_folder(folder / "images") || !is_folder(folder / "pcd")) return false;
  const Paths clouds = files_in(folder / "pcd", {".pcd"});
  return std::any_of(clouds.begin(), clouds.end(),
                     [](const fs::path& p) { return stem_of(p).ends_with("_full"); });
}

PairedFiles acfr_pairs(const fs::path& folder) {
  PairedFiles out;
  out.layout = FileLayout::kCamLidarCalibration;
  const auto without = [](const std::string& suffix) {
    return [suffix](const fs::path& path) {
      const std::string stem = stem_of(path);
      return stem.ends_with(suffix) ? stem.substr(0, stem.size() - suffix.size()) : std::string();
    };
  };
  const Paths images = files_in(folder / "images", kImages);
  const Paths clouds = files_in(folder / "pcd", {".pcd"});
  out.pairs = pairs_by_key(images, clouds, stem_of, without("_full"));
  const auto boards = by_key(clouds, without("_target"));
  for (FilePair& pair : out.pairs) {
    const auto found = boards.find(pair.name);
    if (found != boards.end()) pair.board_points = found->second;
  }
  name_unmatched(images, clouds, out);
  const fs::path tool = folder.parent_path().parent_path();
  find_camera_file({folder, folder.parent_path(), tool / "cfg"}, out);
  return out;
}

PairedFiles visual_pairs(const fs::path& folder) {
  PairedFiles out;
  out.layout = FileLayout::kDirectVisual;
  Paths images = files_in(folder, kImages);
  // Pictures that the tool made of the clouds.
  std::erase_if(images,
                [](const fs::path& p) { return stem_of(p).find("_lidar_") != std::string::npos; });
  const Paths clouds = files_in(folder, {".ply"});
  out.pairs = pairs_by_key(images, clouds, stem_of, stem_of);
  name_unmatched(images, clouds, out);
  if (out.pairs.empty()) return out;
  const fs::path file = folder / "calib.json";
  const auto text = read_text_file(file, kMostText);
  const auto size = size_of(out.pairs.front().image);
  if (text && size) {
    take_camera(camera_of_calib_json(*text, static_cast<int>(size->width_px),
                                     static_cast<int>(size->height_px), file.string()),
                file, out);
  }
  return out;
}

PairedFiles fast_pairs(const fs::path& folder) {
  PairedFiles out;
  out.layout = FileLayout::kFastCalib;
  const Paths images = files_in(folder, kImages);
  const Paths clouds = files_in(folder, kRecordings);
  out.pairs = pairs_by_key(images, clouds, stem_of, stem_of);
  name_unmatched(images, clouds, out);
  for (const fs::path& place :
       {folder, folder / ".." / "config", folder / ".." / ".." / "config"}) {
    const fs::path file = place / "qr_params.yaml";
    if (out.camera || out.pairs.empty() || !is_file(file)) continue;
    const auto size = size_of(out.pairs.front().image);
    if (!size) continue;
    take_camera(camera_of_qr_params(file, static_cast<int>(size->width_px),
                                    static_cast<int>(size->height_px)),
                file, out);
  }
  return out;
}

// ---- Any folders ----

struct Folders {
  fs::path images;
  fs::path clouds;
};

// The folder itself, or the one folder in it that holds such files.
fs::path place_of(const fs::path& folder, const std::set<std::string>& extensions) {
  if (!files_in(folder, extensions).empty()) return folder;
  fs::path out;
  for (const fs::path& inner : folders_in(folder)) {
    if (files_in(inner, extensions).empty()) continue;
    if (!out.empty()) return folder;  // Several: nobody knows which.
    out = inner;
  }
  return out.empty() ? folder : out;
}

std::string first_names(const Paths& files) {
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, files.size()); ++i)
    out += (i == 0 ? "" : ", ") + files[i].filename().string();
  return files.size() > 3 ? out + "…" : out;
}

Result<PairedFiles> other_pairs(const PairOptions& options) {
  const fs::path images_at = place_of(options.images, kImages);
  const fs::path clouds_at =
      place_of(options.clouds.empty() ? options.images : options.clouds, kClouds);
  const Paths images = files_in(images_at, kImages);
  const Paths clouds = files_in(clouds_at, kClouds);
  if (images.empty()) {
    return Error::input(Message("holds no images; expected png, jpg, bmp or tiff files"),
                        images_at.string(), Message("give the folder that holds them"));
  }
  if (clouds.empty()) {
    return Error::input(Message("holds no clouds; expected pcd, ply or KITTI's bin files"),
                        clouds_at.string(), Message("give the folder that holds them"));
  }
  PairedFiles out;
  if (options.rule != PairRule::kTime) {
    out.layout = FileLayout::kSameName;
    out.pairs = pairs_by_key(images, clouds, stem_of, stem_of);
    if (out.pairs.empty()) {
      out.layout = FileLayout::kSameNumber;
      const Key number = [](const fs::path& p) { return number_in(stem_of(p)); };
      // A number that several files have says nothing.
      if (by_key(images, number).size() == images.size() &&
          by_key(clouds, number).size() == clouds.size())
        out.pairs = pairs_by_key(images, clouds, number, number);
    }
  }
  if (out.pairs.empty() && options.rule != PairRule::kName) {
    const auto image_times = timed(images, options.image_time_offset_s);
    const auto cloud_times = timed(clouds, 0.0);
    if (!image_times || !cloud_times) {
      if (options.rule == PairRule::kTime) {
        return Error::input(Message("the names of its files are no times: %1",
                                    first_names(image_times ? clouds : images)),
                            (image_times ? clouds_at : images_at).string(),
                            Message("expected seconds, ms, µs or ns: 1650000000.25.png"));
      }
    } else {
      out.layout = FileLayout::kNearestTime;
      out.pairs = pairs_by_time(*image_times, *cloud_times, options.most_apart_s);
    }
  }
  if (out.pairs.empty()) {
    return Error::input(
        Message("no image and cloud belong together: found %1 and %2", first_names(images),
                first_names(clouds)),
        options.images.string(),
        Message("give both the same name, the same number, or their times as names"));
  }
  name_unmatched(images, clouds, out);
  find_camera_file({options.images, images_at, images_at.parent_path()}, out);
  return out;
}

}  // namespace

std::string name_of(FileLayout layout) {
  switch (layout) {
    case FileLayout::kKittiRaw:
      return "KITTI raw";
    case FileLayout::kCamLidarCalibration:
      return "cam_lidar_calibration";
    case FileLayout::kDirectVisual:
      return "direct_visual_lidar_calibration";
    case FileLayout::kFastCalib:
      return "FAST-Calib";
    case FileLayout::kSameName:
      return "files of the same name";
    case FileLayout::kSameNumber:
      return "files of the same number";
    case FileLayout::kNearestTime:
      break;
  }
  return "files of the nearest time";
}

Message UnmatchedFile::sentence() const {
  return name.empty() ? reason : Message("%1: %2", name, reason);
}

std::optional<double> time_of_name(const std::string& stem) {
  const std::size_t split = stem.find_first_of("._");
  const std::string whole = stem.substr(0, split);
  const std::string part = split == std::string::npos ? "" : stem.substr(split + 1);
  const auto all_digits = [](const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
  };
  if (!all_digits(whole) || whole.size() > 19) return std::nullopt;
  const auto ticks = static_cast<double>(std::strtoull(whole.c_str(), nullptr, 10));
  if (split != std::string::npos) {
    if (!all_digits(part) || whole.size() > 12) return std::nullopt;
    // Behind an underscore stand ns, with leading zeros or without.
    if (stem[split] == '_') {
      if (part.size() > 9) return std::nullopt;
      return ticks + 1e-9 * std::strtod(part.c_str(), nullptr);
    }
    return ticks + std::strtod(("0." + part).c_str(), nullptr);
  }
  // Of a whole number its length says the unit, for times between 2001 and 2286.
  switch (whole.size()) {
    case 10:
      return ticks;
    case 13:
      return 1e-3 * ticks;
    case 16:
      return 1e-6 * ticks;
    case 19:
      return 1e-9 * ticks;
    default:
      return std::nullopt;
  }
}

bool looks_like_file_pairs(const fs::path& folder) {
  if (!is_folder(folder) || is_folder(folder / "scenes") || is_file(folder / "metadata.yaml"))
    return false;
  if (kitti_drive(folder) || is_acfr(folder)) return true;
  if (!files_in(folder, kImages).empty()) {
    return !files_in(folder, kClouds).empty() || !files_in(folder, kRecordings).empty();
  }
  return place_of(folder, kImages) != folder && place_of(folder, kClouds) != folder;
}

Result<PairedFiles> find_pairs(const PairOptions& options) {
  for (const fs::path& folder : {options.images, options.clouds}) {
    if (!folder.empty() && !is_folder(folder))
      return Error::input(Message("is no folder"), folder.string(),
                          Message("give the folder that holds the files"));
  }
  const bool known = options.clouds.empty() && options.rule == PairRule::kAuto;
  if (known) {
    PairedFiles out;
    if (const auto drive = kitti_drive(options.images)) {
      out = kitti_pairs(*drive);
    } else if (is_acfr(options.images)) {
      out = acfr_pairs(options.images);
    } else if (is_file(options.images / "calib.json")) {
      out = visual_pairs(options.images);
    } else if (files_in(options.images, kClouds).empty() &&
               !files_in(options.images, kRecordings).empty()) {
      out = fast_pairs(options.images);
    }
    if (!out.pairs.empty()) return out;
  }
  return other_pairs(options);
}

}  // namespace lvcalib
