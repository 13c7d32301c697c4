// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/demo.h"

#include "base/file_io.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"

namespace lvcalib::widgets {

simulation::SimulationOptions demo_options() {
  simulation::SimulationOptions options;
  options.seed = 6;
  options.scenes = 4;
  options.effects["range_walk"] = 10.0;  // mm
  return options;
}

Status make_demo(const std::filesystem::path& folder, const simulation::SimulationOptions& options,
                 const RunContext& context) {
  context.report("simulate", 0.0, Message());
  const auto simulator = simulation::Simulator::create(options);
  if (!simulator) return simulator.error();
  if (Status s = create_folder(folder.parent_path()); !s) return s;
  auto writer = simulation::DatasetWriter::create(simulator->rig(), folder, true);
  if (!writer) return writer.error();
  int done = 0;
  const Status simulated = simulation::simulate_each(
      *simulator, context, [&](int, const simulation::SimulatedScene& scene) -> Status {
        Status added = writer->add(scene);
        context.report("simulate", static_cast<double>(++done) / options.scenes,
                       Message::verbatim(scene.name));
        return added;
      });
  if (!simulated) return simulated.error();
  if (context.stopped()) return Error::cancelled();
  return writer->finish();
}

}  // namespace lvcalib::widgets
