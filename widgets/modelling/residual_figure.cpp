// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/residual_figure.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace lvcalib::widgets {
namespace {

constexpr int kWidth = 480;
constexpr int kHeight = 300;
constexpr std::size_t kSamples = 20'000;  // for the range of values

// Half the height of the plot: nearly all of the scatter.
double half_height(const ResidualColumns& columns) {
  std::vector<double> size;
  const std::size_t stride = std::max<std::size_t>(1, columns.size() / kSamples);
  for (std::size_t k = 0; k < columns.size(); k += stride)
    size.push_back(std::abs(static_cast<double>(columns.value[k])));
  return size.empty() ? 1.0 : std::max(1.25 * quantile(std::move(size), 0.995), 1e-6);
}

// Evenly spread within ±0.35, the same at every call.
double jitter(std::size_t k) {
  return 0.7 * (std::fmod(0.6180339887 * static_cast<double>(k), 1.0) - 0.5);
}

struct Grid {
  std::vector<float> count = std::vector<float>(static_cast<std::size_t>(kWidth * kHeight));
  void add(int x, int y) {
    if (x < 0 || y < 0 || x >= kWidth || y >= kHeight) return;
    count[static_cast<std::size_t>(y * kWidth + x)] += 1.0F;
  }
};

Grid count_rows(const ResidualFigure& figure, std::stop_token stop) {
  Grid grid;
  const ResidualColumns& c = figure.view->columns;
  const auto& x = figure.along().values;
  // Few points are drawn as small crosses, many as single dots.
  const bool cross = c.size() < 8000;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if ((k & 0xffffU) == 0 && stop.stop_requested()) break;
    double at = figure.place(static_cast<double>(x[k]));
    if (!figure.labels.empty()) at += jitter(k);
    const double px = (at - figure.x_low) / (figure.x_high - figure.x_low) * kWidth;
    const double py = (figure.y_high - static_cast<double>(c.value[k])) /
                      (figure.y_high - figure.y_low) * kHeight;
    if (!(px >= 0.0 && px < kWidth && py >= 0.0 && py < kHeight)) continue;
    const int ix = static_cast<int>(px);
    const int iy = static_cast<int>(py);
    grid.add(ix, iy);
    if (!cross) continue;
    grid.add(ix + 1, iy);
    grid.add(ix - 1, iy);
    grid.add(ix, iy + 1);
    grid.add(ix, iy - 1);
  }
  return grid;
}

// Grey-blue, denser where more residuals are; readable on light and dark ground.
QImage paint(const Grid& grid) {
  QImage image(kWidth, kHeight, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  const float most = *std::max_element(grid.count.begin(), grid.count.end());
  if (most <= 0.0F) return image;
  const double scale = 1.0 / std::log1p(static_cast<double>(most));
  for (int y = 0; y < kHeight; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < kWidth; ++x) {
      const float n = grid.count[static_cast<std::size_t>(y * kWidth + x)];
      if (n <= 0.0F) continue;
      const double share = std::log1p(static_cast<double>(n)) * scale;
      const QColor color = ResidualFigure::dotColor();
      line[x] =
          qRgba(color.red(), color.green(), color.blue(), static_cast<int>(45.0 + 190.0 * share));
    }
  }
  return image;
}

void set_axes(ResidualFigure& figure) {
  const Covariate& c = figure.along();
  if (c.categories) {
    std::vector<float> labels = c.values;
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    figure.labels.assign(labels.begin(), labels.end());
    figure.x_low = 0.4;
    figure.x_high = static_cast<double>(labels.size()) + 0.6;
  } else {
    const auto [low, high] = std::minmax_element(c.values.begin(), c.values.end());
    const double room =
        std::max(0.02 * (static_cast<double>(*high) - static_cast<double>(*low)), 1e-9);
    figure.x_low = static_cast<double>(*low) - room;
    figure.x_high = static_cast<double>(*high) + room;
  }
  figure.y_high = half_height(figure.view->columns);
  figure.y_low = -figure.y_high;
}

}  // namespace

ChannelView make_channel_view(const ModelStep& step, const ModelStep& before, Channel channel) {
  ChannelView view;
  view.columns = residual_columns(step.fitted(), before.fitted(), channel);
  const ResidualColumns& c = view.columns;
  const auto map = [&](const char* x, const char* y) -> ResidualMap {
    const Covariate* cx = c.find(x);
    const Covariate* cy = c.find(y);
    if (cx == nullptr || cy == nullptr) return {};
    return map_residuals(cx->values, cy->values, c.component, c.sample());
  };
  view.image = map("image x", "image y");
  view.board = map("board x", "board y");
  view.angles = map("azimuth", "elevation");
  return view;
}

double ResidualFigure::place(double value) const {
  if (labels.empty()) return value;
  const auto at = std::lower_bound(labels.begin(), labels.end(), value);
  return static_cast<double>(at - labels.begin()) + 1.0;
}

std::shared_ptr<const ResidualFigure> make_residual_figure(
    const std::shared_ptr<const ChannelView>& view, const QString& covariate,
    const std::shared_ptr<const Overlay>& overlay, std::stop_token stop) {
  const Covariate* along = view->columns.find(covariate.toStdString());
  if (along == nullptr) return nullptr;
  auto figure = std::make_shared<ResidualFigure>();
  figure->view = view;
  figure->overlay = overlay;
  figure->covariate = static_cast<std::size_t>(along - view->columns.covariates.data());
  set_axes(*figure);
  const ResidualColumns& c = view->columns;
  double squares = 0.0;
  for (const float sigma : c.sigma)
    squares += static_cast<double>(sigma) * static_cast<double>(sigma);
  figure->noise = c.size() > 0 ? std::sqrt(squares / static_cast<double>(c.size())) : 0.0;
  figure->density = paint(count_rows(*figure, stop));
  if (stop.stop_requested()) return nullptr;
  figure->now = bin_residuals(along->values, along->categories, c.sample());
  if (stop.stop_requested()) return nullptr;
  figure->before = bin_residuals(along->values, along->categories, c.sample_before());
  if (overlay && overlay->pattern.size() == c.size()) {
    figure->predicted =
        bin_residuals(along->values, along->categories, {overlay->pattern, c.sigma, c.scene});
  }
  if (stop.stop_requested()) return nullptr;
  return figure;
}

}  // namespace lvcalib::widgets
