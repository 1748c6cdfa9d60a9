#include "config/sections/noise_rows.h"

namespace skybake::config {
namespace {

constexpr Range voxel_range{1, 16384};
constexpr Range period_range{1, 1e6};
constexpr Range time_range{-1e9, 1e9};
constexpr Range drift_range{-1024, 1024};
constexpr Range time_cells_range{1, 1024};

constexpr Choice sampling_choices[] = {
    {NoiseSampling::centers, "centers", "voxel i of N at (i + 1/2)/N"},
    {NoiseSampling::corners, "corners", "voxel i of N at i/N"},
    {NoiseSampling::slices_at_corners, "slices_at_corners",
     "centers along x and y, corners along z"},
};
constexpr Choice pack_choices[] = {
    {NoisePacking::none, "none", "each channel as it is"},
    {NoisePacking::shape, "shape",
     "of R, G, B and A: remap(R, w - 1, 1, 0, 1) with w = 0.625 G + 0.25 B + 0.125 A"},
    {NoisePacking::detail, "detail", "of R, G and B: 0.625 R + 0.25 G + 0.125 B"},
};

const NoiseField noise_table[] = {
    {"preset", Kind::text, nullptr,
     "name of a noise preset to start from, which the section's keys override",
     KeyFlag::only_shown},
    {"seed", Kind::seed, &Noise::seed, "another seed gives another noise of the same kind",
     Default{"0"}},
    {"size", Kind::voxels, &Noise::size,
     "voxels that the noise is made for; the default of size in [bake.*]", voxel_range,
     Default{"[128, 128, 128]"},
     Hint{"shapes have 128 each, details 32 each; 1 along z gives a picture"},
     Cited{schneider_2015}, Role::usual},
    {"sampling", Kind::choice, &Noise::sampling, "where voxels lie in the tile", sampling_choices,
     Default{R"("centers")"}},
    {"pack", Kind::choice, &Noise::pack, "merge the channels into one, Y", pack_choices,
     Default{R"("none")"}, Cited{takram}},
    {"aliases", Kind::flag, &Noise::aliases,
     "octaves that are too fine for `size` are part of its look, so that no warning names them",
     Default{"false"}, KeyFlag::only_shown, Role::usual},
    {"period", Kind::integer, &Noise::period,
     "frames of a loop in time, after which the noise repeats bit for bit; without it the noise "
     "stands still",
     period_range, Hint{"48 is two seconds of film"}},
    {"time", Kind::integer, &Noise::time,
     "the frame; frames before 0 and from `period` on are repeats", time_range, Default{"0"},
     Needs{"period"}},
    {"time_cells", Kind::integer, &Noise::time_cells,
     "lattice cells per loop along time, of the coarsest octave; finer ones have more",
     time_cells_range, Default{"4"},
     Hint{"twice as many change the noise twice as fast; a single one hardly does"},
     Needs{"period"}},
    {"drift", Kind::frequency, &Noise::drift,
     "whole tiles per loop that the wind carries the noise along x, y and z", drift_range,
     Default{"0"}, Hint{"[1, 0, 0] is a wind of a tile per loop along +x"}, Needs{"period"}},
};

}  // namespace

std::span<const NoiseField> noise_fields() { return noise_table; }

}  // namespace skybake::config
