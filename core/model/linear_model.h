// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "model/effect.h"

namespace lvcalib {

/// Products of Legendre polynomials over the board, its outline at −1 and 1: one of degree 0, two
/// of degree 1, twelve of degrees 2 to 4.
using BoardPolynomials = std::array<double, 15>;
void board_polynomials(const Eigen::Vector2d& unit, BoardPolynomials& out);

/// The board divided into patches of a given side or a little less.
struct BoardPatches {
  BoardPatches() = default;
  BoardPatches(const BoardOutline& outline, double side_m);
  /// The patch that a board point, or the nearest one on the board, lies in.
  [[nodiscard]] int of(const BoardOutline& outline, const Eigen::Vector2d& board_m) const;
  [[nodiscard]] int count() const { return columns * rows; }
  int columns = 0, rows = 0;
};

/// One effect with its shape number and where its parameters stand among the columns.
struct EffectColumns {
  EffectPtr effect;
  double shape = 0.0;
  std::vector<EffectParameter> parameters;
  int first = 0;
  std::vector<std::size_t> zero_sums = {};  ///< See Effect::zero_sums().
  /// What the effect does to ranges and intensities of white print, and its negative on black print
  /// and circles; nothing elsewhere: an effect that knows no print has none of it.
  bool print_contrast = false;
  [[nodiscard]] int count() const { return static_cast<int>(parameters.size()); }
};

/// The candidates of one linearisation, side by side.
class EffectColumnsList {
 public:
  /// Appends an effect (skipping nothing: callers ask why_not_testable first).
  void add(const EffectPtr& effect, double shape, const MeasurementTable& table);
  /// Appends columns of another list.
  void add(EffectColumns columns);
  /// Appends the effect's print contrast (see EffectColumns).
  void add_print_contrast(const EffectPtr& effect, double shape, const MeasurementTable& table);
  [[nodiscard]] const std::vector<EffectColumns>& list() const { return list_; }
  [[nodiscard]] int columns() const { return columns_; }

 private:
  std::vector<EffectColumns> list_;
  int columns_ = 0;
};

/// An effect in use with its values.
struct EffectInUse {
  EffectPtr effect;
  double shape = 0.0;
  Eigen::VectorXd values;  ///< SI
  bool held = false;       ///< The values are given: a fit leaves them as they are.
};

/// Groups of random effects: systematic structure that is not white noise and that no effect
/// explains. Its size is estimated, so that it is not taken for evidence.
enum class VarianceGroup {
  kRangeShape = 0,   ///< Per scene: board polynomials of degree 2 to 4 in the ranges (m).
  kCornerGroup = 1,  ///< Per tag, or per patch of a board without tags: shift in the image (px).
  kBoardShift = 2,   ///< Per scene: the board between camera and LiDAR, in its plane (m),
  kBoardNormal = 3,  ///< along its normal (m),
  kBoardTilt = 4,    ///< tilted (rad),
  kBoardSpin = 5,    ///< turned about its normal (rad).
  kPrintPatch = 6,   ///< Per patch of 0.2 m: shift of the print (m).
  kLineRange = 7,    ///< Per scene and line: offset of the ranges (m).
  kLineGain = 8,     ///< Per scene and line: gain of the intensities (1).
};
constexpr std::size_t kVarianceGroups = 9;
/// Motions of whole boards.
constexpr std::array<VarianceGroup, 4> kBoardMotions{
    VarianceGroup::kBoardShift, VarianceGroup::kBoardNormal, VarianceGroup::kBoardTilt,
    VarianceGroup::kBoardSpin};
/// Variances that are told from zero (µm, a hundredth of a milliradian, a ten-thousandth of a
/// pixel): a group at its own is held there, as absent.
constexpr std::array<double, kVarianceGroups> kAbsentVariance{1e-12, 1e-8,  1e-12, 1e-12, 1e-12,
                                                              1e-12, 1e-12, 1e-12, 1e-9};

/// Columns that belong to one scene: board pose (6, left perturbation), levels (white, black and
/// two slopes), then the random effects.
struct LocalLayout {
  static constexpr int kPose = 6;
  static constexpr int kLevels = kLevelParameters;
  static constexpr int kFixed = kPose + kLevels;
  static constexpr int kRangeTerms = 12;
  static constexpr int kBoardMotions = 6;
  int corner_groups = 0;
  BoardPatches patches;
  int lines = 0;
  [[nodiscard]] int corner_column() const { return kFixed + kRangeTerms; }
  [[nodiscard]] int board_column() const { return corner_column() + 2 * corner_groups; }
  [[nodiscard]] int patch_column() const { return board_column() + kBoardMotions; }
  [[nodiscard]] int line_column() const { return patch_column() + 2 * patches.count(); }
  [[nodiscard]] int size() const { return line_column() + 2 * lines; }
  /// First column and number of columns of a group.
  [[nodiscard]] std::pair<int, int> columns_of(VarianceGroup group) const;
};

/// Cross products of one scene's whitened rows: columns are the local ones, the extrinsic (6, left
/// perturbation), all effect parameters, and the residual. One matrix per channel, upper triangle
/// filled and mirrored.
struct SceneProducts {
  LocalLayout layout;
  std::array<Eigen::MatrixXd, kChannels> products;
  /// Sums of the whitened effect columns' fourth powers, one per effect column.
  std::array<Eigen::VectorXd, kChannels> fourth_powers;
  std::array<int, kChannels> rows{};
  std::array<double, kChannels> inflation{1.0, 1.0, 1.0, 1.0};  ///< See TableScene.
};

/// The model linearised about a state: residuals = measured − predicted − effects in use.
struct Linearization {
  EffectColumnsList columns;
  std::vector<SceneProducts> scenes;
  [[nodiscard]] int effect_columns() const { return columns.columns(); }
  /// Share of a channel's rows on which an effect column acts, 0…1, as three times the inverse of
  /// the column's kurtosis about zero: 1 if it is spread over the rows like a normal variable or
  /// more evenly, s if it is so on a share s of the rows and zero elsewhere.
  [[nodiscard]] double acting_share(Channel channel, int effect_column) const;
  /// Sum of the squares of a whitened effect column over a channel's rows.
  [[nodiscard]] double squares(Channel channel, int effect_column) const;
};

/// Which channels' rows to take.
using ChannelMask = std::array<bool, kChannels>;
inline constexpr ChannelMask kEveryChannel{true, true, true, true};

/// The print as each row of a table saw it last: while a model moves, most predictions follow from
/// there. Starts with what the table's rows saw.
struct PrintMemory {
  PrintMemory() = default;
  explicit PrintMemory(const MeasurementTable& table);
  std::vector<LocalPrint> range, boundary, intensity;
};

/// Which rows a linearisation takes.
struct RowsTaken {
  ChannelMask channels = kEveryChannel;  ///< Those left out stay zero.
  /// Of the same table: used and brought up to date; null: the table's own.
  PrintMemory* memory = nullptr;
};

/// Computes the cross products; scenes in parallel. Cost is linear in rows and in the number of
/// effects that act on a row. Stops early (empty scenes) when asked to.
Linearization linearize(const MeasurementTable& table, const ModelState& state,
                        const std::vector<EffectInUse>& in_use, const EffectColumnsList& columns,
                        const RunContext& context, const RowsTaken& rows = {});

/// The linearisation of some of its effects alone, by their places in its list, in this order.
Linearization picked(const Linearization& linear, const std::vector<std::size_t>& effects);

/// The state moved by left perturbations.
ModelState moved(const ModelState& state, const Vector6d& extrinsic,
                 const std::vector<Vector6d>& boards);

}  // namespace lvcalib
