#include "bakers/march/cloud_light.h"

#include <algorithm>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake {
namespace {

using Plane = std::vector<double>;

// Returns (1 - g) sigma h / 2 for each block, plane by plane.
std::vector<Plane> diffuse_depths(const CloudMedium& medium, const VoxelBlocks& blocks,
                                  int threads) {
    const double backward = backward_share(cloud_phase(medium.optics.particles));
    const double height_m = medium.extent_m[2] / blocks.size[2];
    std::vector<Plane> planes(static_cast<std::size_t>(blocks.size[2]),
                              Plane(blocks.plane_count()));
    parallel_for(blocks.size[2], threads, [&](int k) {
        std::size_t index = 0;
        for (int j = 0; j < blocks.size[1]; ++j) {
            for (int i = 0; i < blocks.size[0]; ++i) {
                planes[static_cast<std::size_t>(k)][index++] =
                    backward / 2 * medium.optics.extinction_per_m * height_m *
                    mean_density(medium, blocks, i, j, k);
            }
        }
    });
    return planes;
}

// Smooths a repeating plane along one axis with the weights s, 1 - 2 s, s.
Plane smoothed(const Plane& plane, const VoxelBlocks& blocks, bool along_x, double s) {
    Plane out(plane.size());
    const int nx = blocks.size[0];
    const int ny = blocks.size[1];
    const auto at = [&](int x, int y) { return plane[occupancy::index_of({nx, ny, 1}, x, y, 0)]; };
    for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
            const double before = along_x ? at(occupancy::wrapped(x - 1, nx), y)
                                          : at(x, occupancy::wrapped(y - 1, ny));
            const double after = along_x ? at(occupancy::wrapped(x + 1, nx), y)
                                         : at(x, occupancy::wrapped(y + 1, ny));
            out[occupancy::index_of({nx, ny, 1}, x, y, 0)] =
                (1 - 2 * s) * at(x, y) + s * (before + after);
        }
    }
    return out;
}

// Returns the s that gives a variance of 2 s d^2 = h^2 / 2 with blocks of width d. It is at most
// 1/4, which removes a checkerboard completely.
double smoothing(const CloudMedium& medium, const VoxelBlocks& blocks, std::size_t axis) {
    const double h = medium.extent_m[2] / blocks.size[2];
    const double d = medium.extent_m[axis] / blocks.size[axis];
    return std::min(0.25, h * h / (4 * d * d));
}

// Carries V through the planes, downwards or upwards. Writes the values at the blocks' centres to
// `shares`, one per block, and returns the mean of V beyond the last plane.
double carry(const CloudMedium& medium, const VoxelBlocks& blocks, const std::vector<Plane>& depths,
             bool downwards, std::vector<float>& shares) {
    Plane share(blocks.plane_count(), 1.0);
    for (int step = 0; step < blocks.size[2]; ++step) {
        const int k = downwards ? blocks.size[2] - 1 - step : step;
        share = smoothed(share, blocks, true, smoothing(medium, blocks, 0));
        share = smoothed(share, blocks, false, smoothing(medium, blocks, 1));
        const Plane& depth = depths[static_cast<std::size_t>(k)];
        float* out = shares.data() + static_cast<std::size_t>(k) * share.size();
        for (std::size_t i = 0; i < share.size(); ++i) {
            const double before = 1 / share[i];
            out[i] = static_cast<float>(1 / (before + depth[i] / 2));
            share[i] = 1 / (before + depth[i]);
        }
    }
    double sum = 0;
    for (const double value : share) sum += value;
    return sum / static_cast<double>(share.size());
}

}  // namespace

std::array<OctavePhase, kOctaves> octave_phases(const CloudPhase& phase) {
    std::array<OctavePhase, kOctaves> octaves;
    double brightness = 1;
    double eccentricity = 1;
    for (OctavePhase& octave : octaves) {
        octave = {brightness, widened(phase, eccentricity)};
        brightness *= kOctaveBrightness;
        eccentricity *= kOctaveHalving;
    }
    return octaves;
}

double sun_scattering(const std::array<OctavePhase, kOctaves>& octaves, double offset, double tau) {
    double sum = 0;
    double thinner = tau;
    for (const OctavePhase& octave : octaves) {
        sum += octave.brightness * phase_value(octave.phase, offset) * exponential(-thinner);
        thinner *= kOctaveHalving;
    }
    return sum;
}

DiffuseShare diffuse_share(const CloudMedium& medium, int block, int threads) {
    const VoxelBlocks blocks(medium.volume.size, {block, block, block});
    const std::vector<Plane> depths = diffuse_depths(medium, blocks, threads);
    std::vector<float> shares(occupancy::count_of(blocks.size));
    DiffuseShare result;
    result.through = carry(medium, blocks, depths, true, shares);
    result.from_sky = padded_volume(shares.data(), blocks.size, 0, 1, threads);
    carry(medium, blocks, depths, false, shares);
    result.from_ground = padded_volume(shares.data(), blocks.size, 0, 1, threads);
    return result;
}

}  // namespace skybake
