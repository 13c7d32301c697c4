// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/rigid3.h"
#include "target/target.h"

namespace lvcalib {

/// The lines that draw a board, in metres of any frame. Every polygon is closed: its last point
/// joins its first.
struct BoardWireframe {
  struct Shape {
    int id = 0;  ///< Tag id or node id.
    std::vector<Eigen::Vector3d> points_m;
  };
  std::vector<Eigen::Vector3d> outline_m;  ///< Edge of the board; `segments` points a side.
  std::vector<Shape> tags;                 ///< Outer squares of the tags, from the lower left.
  std::vector<Shape> circles;              ///< `segments` points each, from the board's +x axis.
};

/// Wireframe of a board whose pose is `frame_from_board`. More segments follow the curves that
/// straight lines become in a distorted image.
BoardWireframe board_wireframe(const Target& target, const Rigid3& frame_from_board,
                               int segments = 48);

}  // namespace lvcalib
