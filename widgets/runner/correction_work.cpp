// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/correction_work.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/file_io.h"
#include "cloud/cloud.h"
#include "report/stored_model.h"

namespace lvcalib::widgets {
namespace {

namespace fs = std::filesystem;

struct CloudJob {
  fs::path from;
  fs::path to;
};

Message said(const QString& text) {
  return Message::verbatim(text.toStdString());
}

bool is_cloud_name(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".pcd" || extension == ".ply";
}

// One cloud, or those of a folder and the folders in it.
Result<std::vector<CloudJob>> clouds_of(const fs::path& input, const fs::path& output) {
  std::error_code code;
  const auto place = [&](const fs::path& p) { return fs::weakly_canonical(p, code); };
  if (place(input) == place(output)) {
    return Error::output(said(CorrectionWork::tr("is the cloud itself, which stays as it is")),
                         output.string(),
                         said(CorrectionWork::tr("choose another place for what is corrected")));
  }
  if (!fs::is_directory(input, code)) return std::vector<CloudJob>{{input, output}};
  std::vector<CloudJob> out;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(input, options, code), end; !code && it != end;
       it.increment(code)) {
    std::error_code inner;
    if (!it->is_regular_file(inner) || !is_cloud_name(it->path())) continue;
    fs::path to = output / it->path().lexically_relative(input);
    out.push_back({it->path(), to.replace_extension(".pcd")});
  }
  // The output may lie in the folder: what is written there is no input of the next run.
  std::erase_if(out, [&](const CloudJob& job) {
    const fs::path inside = place(job.from).lexically_relative(place(output));
    return !inside.empty() && *inside.begin() != "..";
  });
  if (out.empty()) {
    return Error::input(said(CorrectionWork::tr("holds no clouds (.pcd or .ply)")), input.string(),
                        said(CorrectionWork::tr("choose a cloud, or a folder of clouds")));
  }
  std::sort(out.begin(), out.end(),
            [](const CloudJob& a, const CloudJob& b) { return a.from < b.from; });
  return out;
}

Result<CorrectionSummary> correct_one(const CloudJob& job, const StoredModel& model,
                                      const CorrectionOptions& options, const RunContext& context,
                                      std::vector<Message>& warnings) {
  auto cloud = read_cloud(job.from, context.stop, PointChoice::kAll);
  if (!cloud) return cloud.error();
  const auto summary = correct_cloud(*cloud, model.effects, model.scales, options, context);
  if (!summary) {
    Error error = summary.error();
    if (error.where.empty()) error.where = job.from.string();
    return error;
  }
  if (context.stopped()) return Error::cancelled();
  if (Status s = create_folder(fs::absolute(job.to).parent_path()); !s) return s.error();
  if (Status s = write_pcd(job.to, *cloud); !s) return s.error();
  for (const Message& warning : cloud->warnings)
    warnings.emplace_back("%1: %2", job.from.string(), warning);
  return *summary;
}

// RMS over the points of both.
double joined_rms(double a, std::size_t points_a, double b, std::size_t points_b) {
  const auto n = static_cast<double>(points_a + points_b);
  if (n == 0.0) return 0.0;
  return std::sqrt((static_cast<double>(points_a) * a * a + static_cast<double>(points_b) * b * b) /
                   n);
}

void join(CorrectionSummary& total, const CorrectionSummary& one) {
  total.rms_m = joined_rms(total.rms_m, total.points, one.rms_m, one.points);
  total.points += one.points;
  total.no_surface += one.no_surface;
  total.unknown_line += one.unknown_line;
  total.held += one.held;
  total.largest_m = std::max(total.largest_m, one.largest_m);
  if (total.effects.empty()) {
    total.effects = one.effects;
    return;
  }
  for (std::size_t k = 0; k < std::min(total.effects.size(), one.effects.size()); ++k) {
    EffectCorrection& t = total.effects[k];
    const EffectCorrection& e = one.effects[k];
    t.rms_m = joined_rms(t.rms_m, t.points, e.rms_m, e.points);
    t.points += e.points;
    t.largest_m = std::max(t.largest_m, e.largest_m);
  }
}

Result<CorrectedClouds> correct_all(const CalibrationResult& result, const fs::path& input,
                                    const fs::path& output, const CorrectionOptions& options,
                                    const RunContext& context) {
  const auto model = model_of(result);
  if (!model) return model.error();
  const auto jobs = clouds_of(input, output);
  if (!jobs) return jobs.error();
  CorrectedClouds out;
  for (std::size_t i = 0; i < jobs->size(); ++i) {
    const CloudJob& job = (*jobs)[i];
    context.report("correct", static_cast<double>(i) / static_cast<double>(jobs->size()),
                   Message::verbatim(job.from.filename().string()));
    RunContext silent = context;
    silent.progress = nullptr;
    const auto one = correct_one(job, *model, options, silent, out.warnings);
    if (context.stopped()) return Error::cancelled();
    if (one) {
      ++out.clouds;
      join(out.total, *one);
    } else if (jobs->size() == 1) {
      return one.error();
    } else {
      out.problems.push_back(one.error().sentence());
    }
  }
  if (out.clouds == 0) return Error::input(out.problems.front());
  return out;
}

}  // namespace

CorrectionWork::CorrectionWork(QObject* parent) : QObject(parent) {
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString&, double fraction, const QString& text) {
            Q_EMIT progressed(fraction, text);
          });
  connect(&runner_, &Runner::cancelled, this, &CorrectionWork::cancelled);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Error::output(Message::verbatim(message.toStdString())));
  });
}

void CorrectionWork::correct(std::shared_ptr<const CalibrationResult> result, const QString& input,
                             const QString& output, const CorrectionOptions& options) {
  runner_.start([this, result = std::move(result), input, output, options](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto clouds = correct_all(*result, input.toStdString(), output.toStdString(), options, context);
    if (context.stopped()) return {};
    if (!clouds) return [this, error = clouds.error()] { Q_EMIT failed(error); };
    return [this, out = std::move(*clouds)] { Q_EMIT corrected(out); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_correction_work.cpp"
