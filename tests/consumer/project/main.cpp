// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/rigid3.h>
#include <cloud/cloud.h>

int main() {
  lvcalib::Vector6d motion;
  motion << 1, 2, 3, 0.1, 0.2, 0.3;
  const lvcalib::Rigid3 a_from_b = lvcalib::se3_exp(motion);
  const bool inverse_works = (a_from_b * a_from_b.inverse()).translation.norm() < 1e-12;
  return inverse_works && !lvcalib::read_cloud("no-such-file.pcd").ok() ? 0 : 1;
}
