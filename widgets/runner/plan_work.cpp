// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/plan_work.h"

#include <utility>
#include <vector>

#include "cloud/cloud.h"
#include "pipeline/model_discovery.h"

namespace lvcalib::widgets {
namespace {

// The LiDAR that took the scenes: noise and density by its returns on the boards, the field of view
// by a whole cloud.
Result<LidarDescription> lidar_of_scenes(const PlanRequest& request, const RunContext& context,
                                         std::vector<Message>& warnings) {
  const CalibrationResult& result = *request.result;
  context.report("plan", 0.0, Message("collecting measurements"));
  const DiscoveryInput input = discovery_input(result);
  if (!input.print) {
    return Error::untrusted(
        Message::verbatim(
            PlanWork::tr("the scenes do not tell enough of the LiDAR: the joint solve over every "
                         "return failed")
                .toStdString()),
        {}, Message::verbatim(PlanWork::tr("choose a description of the LiDAR").toStdString()));
  }
  const MeasurementTable table = table_of(input, discovery_options(result).table);
  LidarDescription out = lidar_of(table, result.extrinsic.camera_from_lidar.transform);
  if (request.cloud.empty()) return out;
  if (const auto cloud = read_cloud(request.cloud, context.stop)) {
    take_field_of_view(*cloud, out.sensors);
    for (const Message& warning : cloud->warnings)
      warnings.emplace_back("%1: %2", request.cloud.string(), warning);
  }
  return out;
}

Result<ScenePlan> plan(const PlanRequest& request, const RunContext& context) {
  PlanOptions options = request.options;
  std::vector<Message> warnings;
  Result<LidarDescription> lidar = request.lidar ? Result<LidarDescription>(*request.lidar)
                                                 : lidar_of_scenes(request, context, warnings);
  if (!lidar) return lidar.error();
  if (context.stopped()) return Error::cancelled();
  if (request.result) {
    lidar->camera_from_lidar = request.result->extrinsic.camera_from_lidar.transform;
    if (!request.lidar) options.corner_sigma_px = lidar->sensors.corner_sigma_px;
    if (request.go_on) {
      options.known = request.result->extrinsic.camera_from_lidar.covariance;
      for (const SceneSolution& scene : request.result->extrinsic.scenes)
        if (scene.used) options.taken.push_back(scene.camera_from_board);
    }
  }
  auto out = plan_scenes(request.target, request.camera, *lidar, options, context);
  if (out) out->warnings.insert(out->warnings.begin(), warnings.begin(), warnings.end());
  return out;
}

}  // namespace

PlanWork::PlanWork(QObject* parent) : QObject(parent) {
  relay(runner_, this);
  connect(&runner_, &Runner::cancelled, this, [this] {
    Q_EMIT cancelled();
    Q_EMIT ended();
  });
}

void PlanWork::request(const PlanRequest& request) {
  runner_.abandon();
  runner_.start([this, request](const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto out = plan(request, context);
    if (!out) {
      if (out.error().kind == ErrorKind::kCancelled) return {};
      return [this, error = out.error()] { Q_EMIT failed(error); };
    }
    return
        [this, made = std::make_shared<const ScenePlan>(std::move(*out))] { Q_EMIT ready(made); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_plan_work.cpp"
