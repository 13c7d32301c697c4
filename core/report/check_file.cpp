// SPDX-License-Identifier: BSD-3-Clause
#include "report/check_file.h"

#include "base/file_io.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

ordered_json score_json(const EdgeScore& score) {
  return {{"score", score.score},
          {"sigma", score.sigma},
          {"chance", score.chance},
          {"edges", score.edges}};
}

}  // namespace

std::string check_as_json(const EdgeCheck& check, const std::vector<FilePair>& pairs,
                          const std::vector<Message>& warnings) {
  ordered_json j;
  j["version"] = version();
  j["verdict"] = name_of(check.verdict);
  j["reason"] = reason_of(check);
  j["given"] = score_json(check.given);
  j["best"] = score_json(check.best);
  j["gain"] = {{"value", check.gain},
               {"sigma", check.gain_sigma},
               {"that_matters", check.gain_that_matters}};
  j["offset"] = {{"translation_m", list_of(Eigen::Vector3d(check.offset.head<3>()))},
                 {"rotation_rad", list_of(Eigen::Vector3d(check.offset.tail<3>()))},
                 {"rms_px", check.offset_px},
                 {"sigma_px", check.offset_sigma_px}};
  j["covariance"] = rows_of(check.covariance);
  j["T_camera_lidar_best"] = rows_of(check.best_pose.matrix());
  j["widening_mrad"] = check.widening_mrad;
  j["noticed_turn_mrad"] = list_of(Eigen::Vector3d(1e3 * check.noticed_turn_rad));
  j["places"] = ordered_json::array();
  for (const FilePair& pair : pairs) {
    j["places"].push_back(
        {{"name", pair.name}, {"image", pair.image.string()}, {"cloud", pair.cloud.string()}});
  }
  j["warnings"] = ordered_json::array();
  for (const Message& warning : warnings) j["warnings"].push_back(warning);
  return j.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Status write_check(const EdgeCheck& check, const std::vector<FilePair>& pairs,
                   const std::vector<Message>& warnings, const std::filesystem::path& path) {
  return write_file_atomically(path, check_as_json(check, pairs, warnings));
}

}  // namespace lvcalib
