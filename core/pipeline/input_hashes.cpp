// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/input_hashes.h"

#include <array>
#include <fstream>
#include <memory>

#include <openssl/evp.h>

#include "base/parallel.h"

namespace lvcalib {
namespace fs = std::filesystem;

bool hash_file(const fs::path& path, const RunContext& context, InputFile& out) {
  std::ifstream stream(path, std::ios::binary);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(),
                                                                       &EVP_MD_CTX_free);
  if (!stream || !digest || EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1)
    return false;
  std::vector<char> block(1U << 20U);
  out.bytes = 0;
  while (stream) {
    if (context.stopped()) return false;
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto got = static_cast<std::size_t>(stream.gcount());
    if (EVP_DigestUpdate(digest.get(), block.data(), got) != 1) return false;
    out.bytes += got;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
  unsigned int length = 0;
  if (!stream.eof() || EVP_DigestFinal_ex(digest.get(), sum.data(), &length) != 1) return false;
  static constexpr char kDigits[] = "0123456789abcdef";
  out.sha256.clear();
  for (unsigned int k = 0; k < length; ++k) {
    out.sha256 += kDigits[sum[k] >> 4U];
    out.sha256 += kDigits[sum[k] & 15U];
  }
  return true;
}

std::vector<InputFile> hash_inputs(const Dataset& dataset, bool use_crops,
                                   const RunContext& context) {
  std::vector<fs::path> paths = {dataset.path / "target.yaml", dataset.path / "camera.yaml"};
  if (dataset.rough_camera_from_lidar) paths.push_back(dataset.path / "rig.yaml");
  for (const SceneFiles& scene : dataset.scenes) {
    if (scene.problem) continue;
    paths.push_back(scene.image);
    paths.push_back(use_crops && !scene.crop.empty() ? scene.crop : scene.cloud);
  }
  paths.insert(paths.end(), dataset.camera_images.begin(), dataset.camera_images.end());
  std::vector<InputFile> files(paths.size());
  parallel_for(paths.size(), context.thread_count(), [&](std::size_t k) {
    files[k].path = paths[k].lexically_relative(dataset.path).generic_string();
    if (!context.stopped() && !hash_file(paths[k], context, files[k])) files[k].sha256.clear();
  });
  return files;
}

}  // namespace lvcalib
