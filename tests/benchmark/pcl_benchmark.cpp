// SPDX-License-Identifier: GPL-3.0-or-later
// Our generic cloud work beside PCL's on the same data: reading and writing files, thinning by
// voxels, neighbours within a radius, normals and flat patches. The first argument is the number of
// points of a simulated scene; files are warm.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include <benchmark/benchmark.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>
#include <unistd.h>

#include "cloud/cloud.h"
#include "cloud/local_normals.h"
#include "localization/planar_patch.h"
#include "localization/voxel_cloud.h"
#include "simulation/simulator.h"

namespace {

namespace fs = std::filesystem;
using namespace lvcalib;
using PclCloud = pcl::PointCloud<pcl::PointXYZI>;

// As the search for a board of 0.9 m asks for them.
constexpr double kBoard_m = 0.9;
constexpr double kVoxel_m = kBoard_m / 40.0;

// One simulated scene of each size, and its files.
class Scenes {
 public:
  Scenes() : folder_(fs::temp_directory_path() / ("lvcalib_pcl_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  Scenes(const Scenes&) = delete;
  Scenes& operator=(const Scenes&) = delete;
  ~Scenes() { fs::remove_all(folder_); }

  struct Scene {
    Cloud ours;
    PclCloud::Ptr theirs;
    fs::path pcd, ply;
  };
  const Scene& get(std::int64_t points) {
    const auto [entry, fresh] = scenes_.try_emplace(points);
    if (fresh) make(entry->second, points);
    return entry->second;
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  void make(Scene& scene, std::int64_t points) const {
    simulation::SimulationOptions options;
    options.scenes = 1;
    options.lidar.points = static_cast<int>(points);
    options.image.width_px = 640;
    options.image.height_px = 400;
    auto dataset = simulation::simulate(options, {});
    if (!dataset) {
      std::fprintf(stderr, "%s\n", dataset.error().text().c_str());
      std::exit(1);
    }
    scene.ours = std::move(dataset->scenes.front().cloud);
    scene.theirs = std::make_shared<PclCloud>();
    for (std::size_t i = 0; i < scene.ours.size(); ++i) {
      pcl::PointXYZI p;
      p.getVector3fMap() = scene.ours.points_m[i];
      p.intensity = scene.ours.intensity[i];
      scene.theirs->push_back(p);
    }
    scene.pcd = folder_ / (std::to_string(points) + ".pcd");
    scene.ply = folder_ / (std::to_string(points) + ".ply");
    pcl::PCDWriter().writeBinary(scene.pcd, *scene.theirs);
    pcl::PLYWriter().write(scene.ply, *scene.theirs, true, false);
  }

  fs::path folder_;
  std::map<std::int64_t, Scene> scenes_;
};

Scenes& scenes() {
  static Scenes all;
  return all;
}

void count(benchmark::State& state, std::size_t results) {
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["results"] = static_cast<double>(results);
}

void read_ours(benchmark::State& state, fs::path Scenes::Scene::*file) {
  const fs::path& path = scenes().get(state.range(0)).*file;
  std::size_t points = 0;
  for (auto _ : state) points = read_cloud(path)->size();
  count(state, points);
}
void pcd_ours(benchmark::State& state) {
  read_ours(state, &Scenes::Scene::pcd);
}
void ply_ours(benchmark::State& state) {
  read_ours(state, &Scenes::Scene::ply);
}

void pcd_theirs(benchmark::State& state) {
  const std::string path = scenes().get(state.range(0)).pcd;
  PclCloud cloud;
  for (auto _ : state) pcl::PCDReader().read(path, cloud);
  count(state, cloud.size());
}

void ply_theirs(benchmark::State& state) {
  const std::string path = scenes().get(state.range(0)).ply;
  PclCloud cloud;
  for (auto _ : state) pcl::PLYReader().read(path, cloud);
  count(state, cloud.size());
}

void write_ours(benchmark::State& state) {
  const Cloud& cloud = scenes().get(state.range(0)).ours;
  const fs::path path = scenes().file("out.pcd");
  for (auto _ : state) {
    if (!write_pcd(path, cloud)) state.SkipWithError("cannot write");
  }
  count(state, cloud.size());
}

void write_theirs(benchmark::State& state) {
  const PclCloud& cloud = *scenes().get(state.range(0)).theirs;
  const std::string path = scenes().file("out.pcd");
  for (auto _ : state) pcl::PCDWriter().writeBinary(path, cloud);
  count(state, cloud.size());
}

VoxelCloud::Options voxel_options() {
  VoxelCloud::Options options;
  options.voxel_m = kVoxel_m;
  options.cell_m = 0.3 * kBoard_m;
  return options;
}

void voxels_ours(benchmark::State& state) {
  const Cloud& cloud = scenes().get(state.range(0)).ours;
  RunContext context;
  std::size_t voxels = 0;
  for (auto _ : state) voxels = VoxelCloud(cloud, voxel_options(), context).voxels().size();
  count(state, voxels);
}

PclCloud::Ptr thinned(const PclCloud::Ptr& cloud) {
  pcl::VoxelGrid<pcl::PointXYZI> grid;
  grid.setInputCloud(cloud);
  const auto side = static_cast<float>(kVoxel_m);
  grid.setLeafSize(side, side, side);
  auto out = std::make_shared<PclCloud>();
  grid.filter(*out);
  return out;
}

void voxels_theirs(benchmark::State& state) {
  const PclCloud::Ptr& cloud = scenes().get(state.range(0)).theirs;
  std::size_t voxels = 0;
  for (auto _ : state) voxels = thinned(cloud)->size();
  count(state, voxels);
}

// The index is part of it: it is built for each cloud anew.
constexpr double kRadius_m = 0.5 * kBoard_m;
constexpr std::size_t kQueries = 500;

void neighbours_ours(benchmark::State& state) {
  RunContext context;
  const VoxelCloud voxels(scenes().get(state.range(0)).ours, voxel_options(), context);
  std::vector<std::uint32_t> found;
  std::size_t sum = 0;
  const std::size_t stride = std::max<std::size_t>(1, voxels.voxels().size() / kQueries);
  for (auto _ : state) {
    sum = 0;
    for (std::size_t i = 0; i < voxels.voxels().size(); i += stride) {
      voxels.neighbours(voxels.voxels()[i].mean_m, kRadius_m, found);
      sum += found.size();
    }
  }
  count(state, sum);
}

void neighbours_theirs(benchmark::State& state) {
  const auto cloud = thinned(scenes().get(state.range(0)).theirs);
  pcl::search::KdTree<pcl::PointXYZI> tree(false);
  tree.setInputCloud(cloud);
  std::size_t sum = 0;
  const std::size_t stride = std::max<std::size_t>(1, cloud->size() / kQueries);
  pcl::Indices found;
  std::vector<float> distances;
  for (auto _ : state) {
    sum = 0;
    for (std::size_t i = 0; i < cloud->size(); i += stride) {
      tree.radiusSearch((*cloud)[i], kRadius_m, found, distances);
      sum += found.size();
    }
  }
  count(state, sum);
}

void normals_ours(benchmark::State& state) {
  const Cloud& cloud = scenes().get(state.range(0)).ours;
  RunContext context;
  std::size_t flat = 0;
  for (auto _ : state) {
    flat = 0;
    for (const auto& n : local_normals(cloud, {}, context)) flat += n.squaredNorm() > 0.0F ? 1 : 0;
  }
  count(state, flat);
}

pcl::PointCloud<pcl::Normal>::Ptr normals_of(const PclCloud::Ptr& cloud) {
  pcl::NormalEstimationOMP<pcl::PointXYZI, pcl::Normal> estimate;
  estimate.setInputCloud(cloud);
  estimate.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZI>>());
  estimate.setKSearch(12);
  auto out = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  estimate.compute(*out);
  return out;
}

void normals_theirs(benchmark::State& state) {
  const PclCloud::Ptr& cloud = scenes().get(state.range(0)).theirs;
  std::size_t size = 0;
  for (auto _ : state) size = normals_of(cloud)->size();
  count(state, size);
}

// From the whole cloud to its flat patches.
void patches_ours(benchmark::State& state) {
  const Cloud& cloud = scenes().get(state.range(0)).ours;
  RunContext context;
  PatchSearchOptions options;
  options.board_width_m = options.board_height_m = kBoard_m;
  std::size_t patches = 0;
  for (auto _ : state) {
    const VoxelCloud voxels(cloud, voxel_options(), context);
    patches = find_planar_patches(voxels, options, context).size();
  }
  count(state, patches);
}

void patches_theirs(benchmark::State& state) {
  const PclCloud::Ptr& cloud = scenes().get(state.range(0)).theirs;
  std::size_t patches = 0;
  for (auto _ : state) {
    const auto voxels = thinned(cloud);
    pcl::RegionGrowing<pcl::PointXYZI, pcl::Normal> grow;
    grow.setInputCloud(voxels);
    grow.setInputNormals(normals_of(voxels));
    grow.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZI>>());
    grow.setNumberOfNeighbours(12);
    grow.setMinClusterSize(200);
    grow.setSmoothnessThreshold(0.1F);
    grow.setCurvatureThreshold(0.05F);
    std::vector<pcl::PointIndices> found;
    grow.extract(found);
    patches = found.size();
  }
  count(state, patches);
}

}  // namespace

#define LVCALIB_BOTH(name)                                                            \
  BENCHMARK(name##_ours)->Arg(500'000)->Unit(benchmark::kMillisecond)->UseRealTime(); \
  BENCHMARK(name##_theirs)->Arg(500'000)->Unit(benchmark::kMillisecond)->UseRealTime()

LVCALIB_BOTH(pcd);
LVCALIB_BOTH(ply);
LVCALIB_BOTH(write);
LVCALIB_BOTH(voxels);
LVCALIB_BOTH(neighbours);
LVCALIB_BOTH(normals);
LVCALIB_BOTH(patches);

BENCHMARK_MAIN();
