// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/project_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include <yaml-cpp/yaml.h>

#include "base/file_io.h"
#include "base/yaml_file.h"
#include "pipeline/model_discovery.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;

// The shortest text that reads back as the same number.
template <class Number>
std::string number(Number value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

constexpr std::pair<const char*, std::vector<int> SceneEdits::*> kIdLists[] = {
    {"tags", &SceneEdits::tags},
    {"circles", &SceneEdits::circles},
    {"kept_tags", &SceneEdits::kept_tags},
    {"kept_circles", &SceneEdits::kept_circles}};

void emit_list(YAML::Emitter& out, const char* key, const Eigen::Ref<const Eigen::VectorXd>& v) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double x : v) out << number(x);
  out << YAML::EndSeq;
}

// Relative where both are on one file system, so that a folder with both can be moved.
std::string relative_path(const fs::path& path, const fs::path& folder) {
  std::error_code code;
  const fs::path relative = fs::proximate(path, folder, code);
  return (code || relative.empty() ? path : relative).generic_string();
}

void emit_options(YAML::Emitter& out, const CalibrationOptions& options) {
  out << YAML::Key << "options" << YAML::Value << YAML::BeginMap;
  for (const OptionDeclaration& d : option_declarations()) {
    if (d.get(options) == d.default_value()) continue;  // Later defaults may be better ones.
    out << YAML::Key << d.key << YAML::Value << number(d.get(options));
  }
  out << YAML::EndMap;
}

void emit_ids(YAML::Emitter& out, const char* key, const std::vector<int>& ids) {
  if (ids.empty()) return;
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const int id : ids) out << id;
  out << YAML::EndSeq;
}

void emit_edits(YAML::Emitter& out, const SceneEdits& edits) {
  out << YAML::Key << "edits" << YAML::Value << YAML::BeginMap;
  for (const auto& [key, ids] : kIdLists) emit_ids(out, key, edits.*ids);
  if (!edits.points_m.empty()) {
    out << YAML::Key << "points_m" << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (const Eigen::Vector3f& p : edits.points_m) {
      for (const float x : p) out << number(x);
    }
    out << YAML::EndSeq;
  }
  if (!edits.kept_patches.empty()) {
    out << YAML::Key << "kept_patches_m" << YAML::Value << YAML::BeginSeq;
    for (const BoardOutline& part : edits.kept_patches) {
      out << YAML::Flow << YAML::BeginSeq;
      for (const Eigen::Vector2d& p : {part.lower_left_m, part.upper_right_m})
        out << number(p.x()) << number(p.y());
      out << YAML::EndSeq;
    }
    out << YAML::EndSeq;
  }
  if (!edits.patches_m.empty()) {
    out << YAML::Key << "patches_m" << YAML::Value << YAML::BeginSeq;
    for (const auto& patch : edits.patches_m) {
      out << YAML::Flow << YAML::BeginSeq;
      for (const Eigen::Vector2d& p : patch) out << number(p.x()) << number(p.y());
      out << YAML::EndSeq;
    }
    out << YAML::EndSeq;
  }
  out << YAML::EndMap;
}

void emit_scenes(YAML::Emitter& out, const Decisions& decisions) {
  out << YAML::Key << "scenes" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, scene] : decisions.scenes) {
    out << YAML::Key << name << YAML::Value << YAML::BeginMap;
    out << YAML::Key << "use" << YAML::Value << (scene.use ? "true" : "false");
    if (!scene.note.empty())
      out << YAML::Key << "note" << YAML::Value << YAML::DoubleQuoted << scene.note << YAML::Auto;
    if (!scene.edits.empty()) emit_edits(out, scene.edits);
    if (scene.insist) out << YAML::Key << "insist" << YAML::Value << "true";
    if (scene.crop) {
      out << YAML::Key << "crop" << YAML::Value << YAML::BeginMap;
      emit_list(out, "center_m", scene.crop->center_m);
      emit_list(out, "half_size_m", scene.crop->half_size_m);
      emit_list(out, "quaternion_xyzw", scene.crop->rotation.coeffs());
      out << YAML::EndMap;
    }
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
}

Result<bool> flag(const YamlFile& file, const std::string& key, bool otherwise) {
  if (!file.has(key)) return otherwise;
  auto text = file.string(key);
  if (!text) return text.error();
  if (*text == "true") return true;
  if (*text == "false") return false;
  return file.error_at(*file.root().find(key), Message("'%1' must be true or false", key));
}

Result<Rigid3> pose(const YamlFile& file) {
  auto t = file.numbers("translation_m", 3);
  if (!t) return t.error();
  auto q = file.numbers("quaternion_xyzw", 4);
  if (!q) return q.error();
  const Eigen::Quaterniond rotation(Eigen::Vector4d(q->data()));
  if (std::abs(rotation.norm() - 1.0) > 1e-3)
    return file.error_at(file.root(), Message("quaternion_xyzw must have length 1"));
  return Rigid3{rotation, Eigen::Vector3d(t->data())};
}

Result<CropBox> crop_box(const YamlFile& file) {
  auto center = file.numbers("center_m", 3);
  if (!center) return center.error();
  auto half_size = file.numbers("half_size_m", 3);
  if (!half_size) return half_size.error();
  auto q = file.numbers("quaternion_xyzw", 4);
  if (!q) return q.error();
  const CropBox box{Eigen::Vector3d(center->data()), Eigen::Vector3d(half_size->data()),
                    Eigen::Quaterniond(Eigen::Vector4d(q->data()))};
  if (Status s = check(box); !s) return file.error_at(file.root(), s.error().message);
  return box;
}

// The numbers of a list, which come in groups of `together`; none if it is not there.
Result<std::vector<double>> grouped(const YamlFile& file, const YamlValue* list,
                                    const std::string& key, std::size_t together) {
  if (list == nullptr) return std::vector<double>();
  auto numbers = file.flatten(*list, key);
  if (numbers && numbers->size() % together != 0) {
    return file.error_at(*list, Message("'%1' must hold %2 numbers for each place", key, together));
  }
  return numbers;
}

Result<SceneEdits> scene_edits(const YamlFile& file) {
  SceneEdits edits;
  for (const auto& [key, ids] : kIdLists) {
    auto numbers = grouped(file, file.root().find(key), key, 1);
    if (!numbers) return numbers.error();
    for (const double x : *numbers) {
      if (x != std::floor(x) || std::abs(x) > 1e9)
        return file.error_at(*file.root().find(key), Message("'%1' must hold ids", key));
      (edits.*ids).push_back(static_cast<int>(x));
    }
  }
  auto points = grouped(file, file.root().find("points_m"), "points_m", 3);
  if (!points) return points.error();
  for (std::size_t k = 0; k < points->size(); k += 3)
    edits.points_m.emplace_back(Eigen::Vector3d(points->data() + k).cast<float>());
  if (const YamlValue* kept = file.root().find("kept_patches_m"); kept != nullptr) {
    auto corners = grouped(file, kept, "kept_patches_m", 4);
    if (!corners) return corners.error();
    for (std::size_t k = 0; k < corners->size(); k += 4)
      edits.kept_patches.push_back(
          {Eigen::Vector2d(corners->data() + k), Eigen::Vector2d(corners->data() + k + 2)});
  }
  const YamlValue* patches = file.root().find("patches_m");
  if (patches == nullptr) return edits;
  if (patches->kind != YamlValue::Kind::kList)
    return file.error_at(*patches, Message("'patches_m' must be a list of polygons"));
  for (const YamlValue& item : patches->list) {
    auto numbers = grouped(file, &item, "patches_m", 2);
    if (!numbers) return numbers.error();
    auto& patch = edits.patches_m.emplace_back();
    for (std::size_t k = 0; k < numbers->size(); k += 2)
      patch.emplace_back((*numbers)[k], (*numbers)[k + 1]);
  }
  return edits;
}

constexpr std::pair<ModelChange, const char*> kChanges[] = {
    {ModelChange::kAdd, "add"},       {ModelChange::kRemove, "remove"},
    {ModelChange::kSwitchOff, "off"}, {ModelChange::kSwitchOn, "on"},
    {ModelChange::kHold, "hold"},     {ModelChange::kRelease, "release"}};

std::optional<ModelChange> change_named(const std::string& name) {
  for (const auto& [change, text] : kChanges) {
    if (name == text) return change;
  }
  return std::nullopt;
}

void emit_model(YAML::Emitter& out, const std::vector<ModelDecision>& model) {
  if (model.empty()) return;
  out << YAML::Key << "model" << YAML::Value << YAML::BeginSeq;
  for (const ModelDecision& decision : model) {
    const char* name = "add";
    for (const auto& [change, text] : kChanges) {
      if (change == decision.change) name = text;
    }
    out << YAML::BeginMap << YAML::Key << "change" << YAML::Value << name;
    out << YAML::Key << "effect" << YAML::Value << YAML::DoubleQuoted << decision.spec
        << YAML::Auto;
    if (!decision.values.empty()) {
      emit_list(out, "values",
                Eigen::Map<const Eigen::VectorXd>(
                    decision.values.data(), static_cast<Eigen::Index>(decision.values.size())));
    }
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
}

class Reader {
 public:
  Reader(const YamlFile& file, const fs::path& path)
      : file_(file), folder_(fs::absolute(path).parent_path()) {}

  Result<ProjectFile> read() {
    for (const auto step : {&Reader::header, &Reader::paths, &Reader::guess, &Reader::options,
                            &Reader::scenes, &Reader::model, &Reader::frames}) {
      if (Status s = (this->*step)(); !s) return s.error();
    }
    auto unknown =
        file_.unknown_keys({"format", "version", "dataset", "use_crops", "guess", "options",
                            "added_scenes", "scene_order", "scenes", "model", "frames"});
    out_.warnings.insert(out_.warnings.end(), unknown.begin(), unknown.end());
    return std::move(out_);
  }

 private:
  Status header() {
    auto format = file_.has("format") ? file_.string("format") : Result<std::string>(std::string());
    if (!format || *format != "lvcalib-project") {
      return Error::input(Message("is not a project; expected 'format: lvcalib-project'"),
                          file_.name());
    }
    auto version = file_.integer("version", 1, 1'000'000);
    if (!version) return version.error();
    if (*version > kProjectVersion) {
      return Error::input(Message("the project has format version %1, this program knows up to %2",
                                  *version, kProjectVersion),
                          file_.name(),
                          Message("open it with a newer release; it was not changed"));
    }
    return Done{};
  }

  Status paths() {
    auto dataset = file_.string("dataset");
    if (!dataset) return dataset.error();
    if (dataset->empty()) return Error::input(Message("'dataset' is empty"), file_.name());
    out_.project.dataset = absolute(*dataset);
    auto crops = flag(file_, "use_crops", false);
    if (!crops) return crops.error();
    decisions().use_crops = *crops;
    auto added = texts("added_scenes", Message("'%1' must be a list of folders", "added_scenes"));
    if (!added) return added.error();
    for (const std::string& path : *added) decisions().added_scenes.push_back(absolute(path));
    auto order = texts("scene_order", Message("'%1' must be a list of scenes", "scene_order"));
    if (!order) return order.error();
    decisions().scene_order = std::move(*order);
    return Done{};
  }

  // A list of texts; none if it is not there. `expected` says what it must be.
  Result<std::vector<std::string>> texts(const char* key, const Message& expected) {
    std::vector<std::string> out;
    const YamlValue* list = map_or_null(key);
    if (list == nullptr) return out;
    if (list->kind != YamlValue::Kind::kList) return file_.error_at(*list, expected);
    for (const YamlValue& item : list->list) {
      if (item.kind != YamlValue::Kind::kScalar || item.scalar.empty())
        return file_.error_at(item, expected);
      out.push_back(item.scalar);
    }
    return out;
  }

  Status guess() {
    if (!file_.has("guess")) return Done{};
    auto section = file_.section("guess");
    if (!section) return section.error();
    auto value = pose(*section);
    if (!value) return value.error();
    decisions().guess = *value;
    return Done{};
  }

  Status options() {
    const YamlValue* values = map_or_null("options");
    if (values == nullptr) return Done{};
    if (values->kind != YamlValue::Kind::kMap)
      return file_.error_at(*values, Message("'options' must hold 'name: value' entries"));
    for (const auto& [key, value] : values->map) {
      double x = 0;
      if (value.kind != YamlValue::Kind::kScalar || !parse_number(value.scalar, x))
        return file_.error_at(value, Message("'%1' must be a number", key));
      if (Status s = set_option(decisions().options, key, x); !s) {
        if (s.error().kind != ErrorKind::kUsage) return file_.error_at(value, s.error().message);
        out_.warnings.push_back(
            Message("%1:%2: %3", file_.name(), value.line, s.error().sentence()));
      }
    }
    return Done{};
  }

  Status scenes() {
    if (map_or_null("scenes") == nullptr) return Done{};
    auto all = file_.section("scenes");
    if (!all) return all.error();
    for (const auto& entry : all->root().map) {
      auto section = all->section(entry.first);
      if (!section) return section.error();
      auto use = flag(*section, "use", true);
      if (!use) return use.error();
      auto insist = flag(*section, "insist", false);
      if (!insist) return insist.error();
      SceneDecision decision;
      decision.use = *use;
      decision.insist = *insist;
      if (section->has("note")) {
        auto note = section->string("note");
        if (!note) return note.error();
        decision.note = *note;
      }
      if (section->has("edits")) {
        auto inner = section->section("edits");
        if (!inner) return inner.error();
        auto edits = scene_edits(*inner);
        if (!edits) return edits.error();
        decision.edits = std::move(*edits);
      }
      if (section->has("crop")) {
        auto inner = section->section("crop");
        if (!inner) return inner.error();
        auto box = crop_box(*inner);
        if (!box) return box.error();
        decision.crop = *box;
      }
      const auto unknown = section->unknown_keys({"use", "insist", "crop", "note", "edits"});
      out_.warnings.insert(out_.warnings.end(), unknown.begin(), unknown.end());
      decisions().scenes[entry.first] = decision;
    }
    return Done{};
  }

  Status model() {
    const YamlValue* list = map_or_null("model");
    if (list == nullptr) return Done{};
    if (list->kind != YamlValue::Kind::kList)
      return file_.error_at(*list, Message("'model' must be a list of changes"));
    for (const YamlValue& item : list->list) {
      ModelDecision decision;
      const YamlValue* change = item.find("change");
      const YamlValue* effect = item.find("effect");
      if (change == nullptr || effect == nullptr || effect->scalar.empty())
        return file_.error_at(item, Message("a change of the model needs 'change' and 'effect'"));
      const auto known = change_named(change->scalar);
      if (!known) {
        return file_.error_at(
            *change,
            Message("unknown change '%1' (add, remove, off, on, hold or release)", change->scalar));
      }
      decision.change = *known;
      decision.spec = effect->scalar;
      if (const YamlValue* values = item.find("values"); values != nullptr) {
        auto numbers = file_.flatten(*values, "values");
        if (!numbers) return numbers.error();
        decision.values = *numbers;
      }
      out_.project.model.push_back(std::move(decision));
    }
    return Done{};
  }

  Status frames() {
    if (map_or_null("frames") == nullptr) return Done{};
    auto section = file_.section("frames");
    if (!section) return section.error();
    ProjectFrames frames;
    for (const auto& [key, name] :
         {std::pair("lidar", &frames.lidar), std::pair("camera", &frames.camera)}) {
      auto text = section->string(key);
      if (!text) return text.error();
      *name = *text;
    }
    const auto unknown = section->unknown_keys({"lidar", "camera"});
    out_.warnings.insert(out_.warnings.end(), unknown.begin(), unknown.end());
    out_.project.frames = std::move(frames);
    return Done{};
  }

  [[nodiscard]] const YamlValue* map_or_null(const char* key) const {
    const YamlValue* value = file_.root().find(key);
    return value == nullptr || value->kind == YamlValue::Kind::kNull ? nullptr : value;
  }
  [[nodiscard]] fs::path absolute(const std::string& path) const {
    return (folder_ / path).lexically_normal();
  }
  Decisions& decisions() { return out_.project.decisions; }

  const YamlFile& file_;
  fs::path folder_;
  ProjectFile out_;
};

}  // namespace

std::string project_as_text(const Project& project, const fs::path& folder) {
  const Decisions& d = project.decisions;
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "format" << YAML::Value << "lvcalib-project";
  out << YAML::Key << "version" << YAML::Value << kProjectVersion;
  out << YAML::Key << "dataset" << YAML::Value << YAML::DoubleQuoted
      << relative_path(project.dataset, folder) << YAML::Auto;
  out << YAML::Key << "use_crops" << YAML::Value << (d.use_crops ? "true" : "false");
  if (d.guess) {
    out << YAML::Key << "guess" << YAML::Value << YAML::BeginMap;
    emit_list(out, "translation_m", d.guess->translation);
    emit_list(out, "quaternion_xyzw", d.guess->rotation.coeffs());
    out << YAML::EndMap;
  }
  emit_options(out, d.options);
  out << YAML::Key << "added_scenes" << YAML::Value << YAML::BeginSeq;
  for (const fs::path& path : d.added_scenes)
    out << YAML::DoubleQuoted << relative_path(path, folder) << YAML::Auto;
  out << YAML::EndSeq;
  if (!d.scene_order.empty()) {
    out << YAML::Key << "scene_order" << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (const std::string& name : d.scene_order) out << YAML::DoubleQuoted << name << YAML::Auto;
    out << YAML::EndSeq;
  }
  emit_scenes(out, d);
  emit_model(out, project.model);
  if (project.frames) {
    out << YAML::Key << "frames" << YAML::Value << YAML::BeginMap;
    out << YAML::Key << "lidar" << YAML::Value << YAML::DoubleQuoted << project.frames->lidar
        << YAML::Auto;
    out << YAML::Key << "camera" << YAML::Value << YAML::DoubleQuoted << project.frames->camera
        << YAML::Auto << YAML::EndMap;
  }
  out << YAML::EndMap;
  return std::string("# LV-Calib Workbench project; paths are relative to this file.\n") +
         out.c_str() + "\n";
}

Status write_project(const fs::path& path, const Project& project) {
  return write_file_atomically(path, project_as_text(project, fs::absolute(path).parent_path()));
}

Result<ProjectFile> read_project(const fs::path& path) {
  auto file = YamlFile::load(path);
  if (!file) return file.error();
  return Reader(*file, path).read();
}

Result<ProjectFile> project_from_text(const std::string& text, const fs::path& path) {
  auto file = YamlFile::parse(text, path.string());
  if (!file) return file.error();
  return Reader(*file, path).read();
}

Result<OpenedProject> open_project_dataset(const Project& project) {
  OpenedProject opened;
  std::error_code code;
  if (!fs::is_directory(project.dataset, code)) {
    opened.dataset_moved = true;
    return opened;
  }
  auto dataset = open_dataset(project.dataset, UnusableScenes::kLeaveOut);
  if (!dataset) return dataset.error();
  opened.dataset = std::move(*dataset);
  for (const fs::path& folder : project.decisions.added_scenes) {
    if (Status s = add_scenes(opened.dataset, {folder}); !s) {
      opened.warnings.push_back(s.error().sentence());
      opened.missing_scenes.push_back(folder.filename().string());
    }
  }
  for (const auto& entry : project.decisions.scenes) {
    const auto& scenes = opened.dataset.scenes;
    const bool found = std::any_of(scenes.begin(), scenes.end(), [&](const SceneFiles& files) {
      return files.name == entry.first;
    });
    auto& missing = opened.missing_scenes;
    if (!found && std::find(missing.begin(), missing.end(), entry.first) == missing.end())
      missing.push_back(entry.first);
  }
  return opened;
}

Result<std::shared_ptr<const CalibrationResult>> calibrate_project(const Project& project,
                                                                   const RunContext& context) {
  const auto opened = open_project_dataset(project);
  if (!opened) return opened.error();
  if (opened->dataset_moved) {
    return Error::input(Message("the project's dataset is not there"), project.dataset.string(),
                        Message("open the project and say where the dataset is now, then save it"));
  }
  const SessionRun run = run_session(opened->dataset, project.decisions, {}, context);
  if (run.error) return *run.error;
  const auto base = run.state.latest;
  if (project.model.empty()) return base;
  auto step = start_model(discovery_input(*base), discovery_options(*base), context);
  if (!step) return step.error();
  std::vector<ModelStepPtr> steps = {*step};
  for (const ModelDecision& decision : project.model) {
    auto next = apply_decision(steps.back(), decision, context);
    if (!next) return next.error();
    steps.push_back(*next);
  }
  return result_at(base, steps);
}

}  // namespace lvcalib
