#include "bakers/clouds/grown_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/math/transcendental.h"
#include "bakers/math/wrapped.h"

namespace skybake::cloud {
namespace {

std::array<float, 4> cubic_weights(double t) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return {
        static_cast<float>(-0.5 * t + t2 - 0.5 * t3), static_cast<float>(1 - 2.5 * t2 + 1.5 * t3),
        static_cast<float>(0.5 * t + 2 * t2 - 1.5 * t3), static_cast<float>(-0.5 * t2 + 0.5 * t3)};
}

float cubic_between(const std::array<float, 4>& weights, float a, float b, float c, float d) {
    const float value = (weights[0] * a + weights[1] * b) + (weights[2] * c + weights[3] * d);
    return std::clamp(value, std::min(b, c), std::max(b, c));
}

float density_of_water(float water, float full) {
    if (water <= 0) return 0;
    if (water >= full) return 1;
    return static_cast<float>(exponential(2.0 / 3.0 * logarithm(double{water / full})));
}

VoxelBox part_within(const VoxelBox& box, int depth) {
    VoxelBox inside = box;
    inside.origin[2] = std::clamp(box.origin[2], 0, depth);
    inside.size[2] = std::clamp(box.origin[2] + box.size[2], 0, depth) - inside.origin[2];
    return inside;
}

// Returns a row of cells. Below the base and above the top they go on as the outermost cells are.
const float* row_of(const std::vector<float>& field, const std::array<int, 3>& cells, int y,
                    int z) {
    const auto at = static_cast<std::size_t>(std::clamp(z, 0, cells[2] - 1)) *
                        static_cast<std::size_t>(cells[1]) +
                    static_cast<std::size_t>(skybake::wrapped(y, cells[1]));
    return field.data() + at * static_cast<std::size_t>(cells[0]);
}

// Returns `value(at, x, y, z)` for each cell, where at(x, y, z) is the field.
template <class Value>
std::vector<float> made_of(const std::vector<float>& field, const std::array<int, 3>& cells,
                           const Value& value) {
    const auto at = [&](int x, int y, int z) {
        return double{row_of(field, cells, y, z)[skybake::wrapped(x, cells[0])]};
    };
    std::vector<float> made;
    for (int z = 0; z < cells[2]; ++z) {
        for (int y = 0; y < cells[1]; ++y) {
            for (int x = 0; x < cells[0]; ++x) {
                made.push_back(static_cast<float>(value(at, x, y, z)));
            }
        }
    }
    return made;
}

std::vector<float> slopes_of(const convection::GrownCloud& cloud,
                             const std::array<double, 3>& cell_m) {
    std::vector<float> slopes =
        made_of(cloud.water, cloud.cells, [&](const auto& at, int x, int y, int z) {
            const double along_x = (at(x + 1, y, z) - at(x - 1, y, z)) / (2 * cell_m[0]);
            const double along_y = (at(x, y + 1, z) - at(x, y - 1, z)) / (2 * cell_m[1]);
            const double along_z = (at(x, y, z + 1) - at(x, y, z - 1)) / (2 * cell_m[2]);
            return std::sqrt(along_x * along_x + along_y * along_y + along_z * along_z);
        });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::array<int, 3> step = {axis == 0, axis == 1, axis == 2};
        slopes = made_of(slopes, cloud.cells, [&](const auto& at, int x, int y, int z) {
            return (at(x - step[0], y - step[1], z - step[2]) + 2 * at(x, y, z) +
                    at(x + step[0], y + step[1], z + step[2])) /
                   4;
        });
    }
    return slopes;
}

// Leaves out the octaves that voxels cannot show, but never all.
void leave_out_fine(NoiseOctaves& octaves, const std::array<int, 3>& size) {
    for (std::size_t i = octaves.frequencies.size(); i-- > 0 && octaves.frequencies.size() > 1;) {
        if (!config::is_coarse(octaves.frequencies[i], size)) continue;
        octaves.frequencies.erase(octaves.frequencies.begin() + static_cast<std::ptrdiff_t>(i));
        octaves.gains.erase(octaves.gains.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

Relief relief_of(const Cloud& cloud, const Noise* detail, const std::array<int, 3>& size) {
    Relief relief;
    if (detail == nullptr || cloud.convection.relief == 0) return relief;
    Noise scaled = cloud_noise(*detail, cloud.detail_scale, config::CloudChannels::density);
    for (NoiseChannel& channel : scaled.channels) {
        leave_out_fine(channel.octaves, size);
        leave_out_fine(channel.worley_octaves, size);
    }
    relief.noise = std::make_shared<const noise::NoiseField>(noise::make_noise_plan(scaled, size));
    const auto& octaves = scaled.channels.front().octaves.frequencies;
    const std::array<int, 3>& billows = octaves.empty() ? cloud.detail_scale : octaves.front();
    relief.width_m = cloud.extent[0].meters;
    for (std::size_t i = 0; i < 3; ++i) {
        relief.width_m = std::min(relief.width_m, cloud.extent[i].meters / billows[i]);
    }
    relief.height_m = cloud.convection.relief * relief.width_m;
    return relief;
}

}  // namespace

GrownVolume::GrownVolume(std::shared_ptr<const convection::GrownCloud> cloud,
                         const std::array<double, 3>& cell_m, const std::array<int, 3>& size,
                         Relief relief, double coverage)
    : cloud_(std::move(cloud)),
      size_(size),
      cell_m_(cell_m),
      relief_(std::move(relief)),
      added_(static_cast<float>((coverage - 1) * double{cloud_->full_water})),
      slopes_(slopes_of(*cloud_, cell_m)) {
    const std::ptrdiff_t plane = std::ptrdiff_t{cloud_->cells[0]} * cloud_->cells[1];
    for (auto z = cloud_->water.begin(); z != cloud_->water.end(); z += plane) {
        most_.push_back(*std::max_element(z, z + plane));
    }
    double voxel_m = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        voxel_m = std::max(voxel_m, cell_m[axis] * cloud_->cells[axis] / size[axis]);
        for (int i = 0; i < size[axis]; ++i) {
            const double at = (i + 0.5) * cloud_->cells[axis] / size[axis] - 0.5;
            const double cell = std::floor(at);
            taps_[axis].push_back({static_cast<int>(cell) - 1, cubic_weights(at - cell)});
        }
    }
    const double blur_m = *std::ranges::min_element(cell_m);
    blur_m_ = static_cast<float>(blur_m);
    sharpness_ = static_cast<float>(1 + blur_m / voxel_m);
}

GrownVolume::Cells GrownVolume::cells_of(std::size_t axis, const VoxelBox& box) const {
    const int first = taps_at(axis, box.origin[axis]).first;
    return {first, taps_at(axis, box.origin[axis] + box.size[axis] - 1).first + 4 - first};
}

void GrownVolume::along_x(const VoxelBox& box, const float* cells, float* out) const {
    for (int x = 0; x < box.size[0]; ++x) {
        const Taps& taps = taps_at(0, box.origin[0] + x);
        std::array<float, 4> taken;
        for (std::size_t i = 0; i < 4; ++i) {
            taken[i] = cells[skybake::wrapped(taps.first + static_cast<int>(i), cloud_->cells[0])];
        }
        out[x] = cubic_between(taps.weights, taken[0], taken[1], taken[2], taken[3]);
    }
}

void GrownVolume::along(std::size_t axis, const VoxelBox& box, std::size_t width, const float* from,
                        float* out) const {
    const int first = cells_of(axis, box).first;
    for (int i = 0; i < box.size[axis]; ++i) {
        const Taps& taps = taps_at(axis, box.origin[axis] + i);
        const float* a = from + static_cast<std::size_t>(taps.first - first) * width;
        for (std::size_t k = 0; k < width; ++k) {
            *out++ =
                cubic_between(taps.weights, a[k], a[width + k], a[2 * width + k], a[3 * width + k]);
        }
    }
}

void GrownVolume::interpolate(const std::vector<float>& field, const VoxelBox& box,
                              float* out) const {
    const auto width = static_cast<std::size_t>(box.size[0]);
    const std::size_t plane = width * static_cast<std::size_t>(box.size[1]);
    const Cells rows = cells_of(1, box);
    const Cells slices = cells_of(2, box);
    std::vector<float> slice(width * static_cast<std::size_t>(rows.count));
    std::vector<float> made(plane * static_cast<std::size_t>(slices.count));
    for (int z = 0; z < slices.count; ++z) {
        for (int y = 0; y < rows.count; ++y) {
            along_x(box, row_of(field, cloud_->cells, rows.first + y, slices.first + z),
                    slice.data() + static_cast<std::size_t>(y) * width);
        }
        along(1, box, width, slice.data(), made.data() + static_cast<std::size_t>(z) * plane);
    }
    along(2, box, plane, made.data(), out);
}

double GrownVolume::relief_m(double z) const {
    const double nearer_end = std::min(z + 0.5, size_[2] - (z + 0.5)) / size_[2];
    const double distance_m = nearer_end * cloud_->cells[2] * cell_m_[2];
    return relief_.height_m * std::min(1.0, distance_m / relief_.width_m);
}

void GrownVolume::add_relief(const VoxelBox& box, const std::vector<float>& slopes,
                             float* water) const {
    const std::size_t count = slopes.size();
    std::vector<float> noise(count);
    relief_.noise->fill(box, {noise.data()});
    const std::size_t plane = count / static_cast<std::size_t>(box.size[2]);
    for (std::size_t z = 0, i = 0; i < count; ++z) {
        const auto r_m = static_cast<float>(relief_m(static_cast<double>(z) + box.origin[2]));
        for (const std::size_t end = i + plane; i < end; ++i) {
            water[i] += slopes[i] * r_m * (2 * std::clamp(noise[i], 0.0F, 1.0F) - 1);
        }
    }
}

void GrownVolume::sharpen_edges(const VoxelBox& box, const std::vector<float>& slopes,
                                float* water) const {
    const std::size_t plane = slopes.size() / static_cast<std::size_t>(box.size[2]);
    for (std::size_t z = 0, i = 0; i < slopes.size(); ++z) {
        const int below = taps_at(2, box.origin[2] + static_cast<int>(z)).first + 1;
        const float most = std::max(most_at(below), most_at(below + 1));
        for (const std::size_t end = i + plane; i < end; ++i) {
            const float wet = water[i] + added_;
            water[i] = std::min({sharpness_ * wet, wet + slopes[i] * blur_m_, most});
        }
    }
}

void GrownVolume::fill(const VoxelBox& asked, const std::vector<float*>& channels) const {
    float* out = channels.front();
    if (out == nullptr) return;
    std::fill_n(out, asked.count(), 0.0F);
    const VoxelBox box = part_within(asked, size_[2]);
    if (box.count() == 0) return;
    float* first = out + std::int64_t{box.origin[2] - asked.origin[2]} * box.size[0] * box.size[1];
    interpolate(cloud_->water, box, first);
    std::vector<float> slopes(static_cast<std::size_t>(box.count()));
    interpolate(slopes_, box, slopes.data());
    if (relief_.noise) add_relief(box, slopes, first);
    sharpen_edges(box, slopes, first);
    for (std::int64_t i = 0; i < box.count(); ++i) {
        first[i] = density_of_water(first[i], cloud_->full_water);
    }
}

bool GrownVolume::is_empty(const VoxelBox& asked) const {
    const VoxelBox box = part_within(asked, size_[2]);
    if (box.count() == 0) return true;
    const std::array<Cells, 3> cells = {cells_of(0, box), cells_of(1, box), cells_of(2, box)};
    // The outermost cells add nothing of their own: values lie between those of the inner ones.
    const auto greatest = [&](const std::vector<float>& field) {
        float most = -std::numeric_limits<float>::infinity();
        for (int z = 1; z + 1 < cells[2].count; ++z) {
            for (int y = 1; y + 1 < cells[1].count; ++y) {
                const float* values =
                    row_of(field, cloud_->cells, cells[1].first + y, cells[2].first + z);
                for (int x = 1; x + 1 < cells[0].count; ++x) {
                    most = std::max(most,
                                    values[skybake::wrapped(cells[0].first + x, cloud_->cells[0])]);
                }
            }
        }
        return double{most};
    };
    const double water = greatest(cloud_->water) + double{added_};
    if (water > 0 || !relief_.noise) return water <= 0;
    constexpr double kRoom = 1e-5;  // for what kernels round
    return water + (1 + kRoom) * greatest(slopes_) * relief_.height_m <= 0;
}

CloudVolume volume_of_grown(const std::shared_ptr<const convection::GrownCloud>& grown,
                            const Cloud& cloud, const Noise* detail, const std::array<int, 3>& size,
                            double coverage) {
    CloudVolume volume;
    SourceVoxels& source = volume.source;
    std::array<double, 3> cell_m{};
    for (std::size_t i = 0; i < 3; ++i) {
        source.size[i] = std::max(size[i], grown->cells[i]);
        source.voxel_size_m[i] = cloud.extent[i].meters / source.size[i];
        cell_m[i] = cloud.extent[i].meters / grown->cells[i];
    }
    source.voxels = std::make_shared<const GrownVolume>(
        grown, cell_m, source.size, relief_of(cloud, detail, source.size), coverage);
    source.largest = 1;
    volume.wrap = config::VolumeWrap::repeat;
    if (!grown->velocity.empty()) volume.flow = grown;
    return volume;
}

}  // namespace skybake::cloud
