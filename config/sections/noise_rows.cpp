#include "config/sections/noise_rows.h"

#include <array>
#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range voxel_range{1, 16384};
constexpr Range period_range{1, 1e6};
constexpr Range time_range{-1e9, 1e9};
constexpr Range drift_range{-1024, 1024};
constexpr Range time_cells_range{1, 1024};

constexpr std::array sampling_choices = {
    Choice{NoiseSampling::centers, "centers", "voxel i of N at (i + 1/2)/N"},
    Choice{NoiseSampling::corners, "corners", "voxel i of N at i/N"},
    Choice{NoiseSampling::slices_at_corners, "slices_at_corners",
           "centers along x and y, corners along z"},
};
constexpr std::array pack_choices = {
    Choice{NoisePacking::none, "none", "each channel as it is"},
    Choice{NoisePacking::shape, "shape",
           "of R, G, B and A: remap(R, w - 1, 1, 0, 1) with w = 0.625 G + 0.25 B + 0.125 A"},
    Choice{NoisePacking::detail, "detail", "of R, G and B: 0.625 R + 0.25 G + 0.125 B"},
};

const std::array noise_table = {
    NoiseField{
        {.key = "preset",
         .kind = Kind::text,
         .documentation = "name of a noise preset to start from, which the section's keys override",
         .only_shown = true},
        {}},
    NoiseField{{.key = "seed",
                .kind = Kind::seed,
                .fallback = "0",
                .documentation = "another seed gives another noise of the same kind"},
               &Noise::seed},
    NoiseField{
        {.key = "size",
         .kind = Kind::voxels,
         .range = voxel_range,
         .fallback = "[128, 128, 128]",
         .documentation = "voxels that the noise is made for; the default of size in [bake.*]",
         .hint = "shapes have 128 each, details 32 each; 1 along z gives a picture",
         .citation = schneider_2015,
         .role = Role::usual},
        &Noise::size},
    NoiseField{{.key = "sampling",
                .kind = Kind::choice,
                .choices = sampling_choices,
                .fallback = R"("centers")",
                .documentation = "where voxels lie in the tile"},
               &Noise::sampling},
    NoiseField{{.key = "pack",
                .kind = Kind::choice,
                .choices = pack_choices,
                .fallback = R"("none")",
                .documentation = "merge the channels into one, Y",
                .citation = takram},
               &Noise::pack},
    NoiseField{{.key = "aliases",
                .kind = Kind::flag,
                .fallback = "false",
                .documentation = "octaves that are too fine for `size` are part of its look, so "
                                 "that no warning names them",
                .only_shown = true,
                .role = Role::usual},
               &Noise::aliases},
    NoiseField{{.key = "period",
                .kind = Kind::integer,
                .range = period_range,
                .documentation = "frames of a loop in time, after which the noise repeats bit for "
                                 "bit; without it the noise stands still",
                .hint = "48 is two seconds of film"},
               &Noise::period},
    NoiseField{{.key = "time",
                .kind = Kind::integer,
                .range = time_range,
                .fallback = "0",
                .documentation = "the frame; frames before 0 and from `period` on are repeats",
                .needs = "period"},
               &Noise::time},
    NoiseField{{.key = "time_cells",
                .kind = Kind::integer,
                .range = time_cells_range,
                .fallback = "4",
                .documentation = "lattice cells per loop along time",
                .hint = "twice as many change the noise twice as fast; a single one hardly does",
                .needs = "period"},
               &Noise::time_cells},
    NoiseField{{.key = "drift",
                .kind = Kind::frequency,
                .range = drift_range,
                .fallback = "0",
                .documentation = "whole tiles per loop that the wind carries the noise along x, y "
                                 "and z",
                .hint = "[1, 0, 0] is a wind of a tile per loop along +x",
                .needs = "period"},
               &Noise::drift},
};

}  // namespace

std::span<const NoiseField> noise_fields() { return noise_table; }

}  // namespace skybake::config
