// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The catalogue. A new effect is a file in this folder that defines EffectPtr make_NAME(), and one
// line here; the order is that of lists.
#define LVCALIB_EFFECTS(X)  \
  X(range_offset)           \
  X(range_scale)            \
  X(range_walk)             \
  X(range_incidence)        \
  X(range_cyclic)           \
  X(range_near)             \
  X(range_warmup)           \
  X(range_drift)            \
  X(channel_range_offset)   \
  X(boundary_range_pull)    \
  X(angle_zero)             \
  X(angle_scale)            \
  X(encoder_eccentricity)   \
  X(axis_wobble)            \
  X(channel_angle_offset)   \
  X(beam_origin_offset)     \
  X(encoder_lag)            \
  X(boundary_bias)          \
  X(beam_divergence)        \
  X(footprint_anisotropy)   \
  X(footprint_offset)       \
  X(blooming)               \
  X(detector_lag)           \
  X(intensity_geometry)     \
  X(intensity_nonlinearity) \
  X(specular_lobe)          \
  X(receiver_saturation)    \
  X(board_bow)              \
  X(print_scale)            \
  X(ink_gain)               \
  X(intrinsics_error)       \
  X(distortion_residual)    \
  X(corner_bias)            \
  X(scan_motion)            \
  X(rolling_shutter)
