// What must hold of every recipe that parses, checked for the fuzzers.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <variant>

#include "config/recipe.h"

namespace skybake::config::fuzzing {

inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "property broken: %s\n", property);
    std::abort();
}

inline bool within(double value, double minimum, double maximum) {
    return value >= minimum && value <= maximum;  // false for NaN
}

inline void check_layer(const Layer& layer, std::size_t channels) {
    require(layer.enabled, "only enabled layers are left");
    require(layer.scattering.size() == channels, "one scattering coefficient per channel");
    require(layer.extinction.size() == channels, "one extinction coefficient per channel");
    for (std::size_t i = 0; i < channels; ++i) {
        const double scattering = layer.scattering[i].per_meter;
        const double extinction = layer.extinction[i].per_meter;
        require(within(scattering, 0, 1e6), "scattering in range");
        require(within(extinction, scattering, 1e6), "extinction from scattering up");
    }
    require(std::fabs(layer.g) < 1, "g in (-1, 1)");
    if (layer.profile == Profile::exponential) {
        require(within(layer.scale_height.meters, 1e-3, 1e9), "scale height in range");
    }
    if (layer.profile == Profile::tent) {
        require(within(layer.half_width.meters, 1e-3, 1e9), "half width in range");
    }
    if (layer.profile == Profile::slab) {
        require(layer.top_altitude.meters > layer.bottom_altitude.meters, "slab has a thickness");
    }
    if (layer.profile == Profile::tabulated) {
        require(layer.table.size() >= 2, "at least two entries");
        require(layer.table[0].altitude.meters >= 0, "no negative altitude");
        for (std::size_t i = 1; i < layer.table.size(); ++i) {
            require(layer.table[i].altitude.meters > layer.table[i - 1].altitude.meters,
                    "altitudes increase");
        }
        for (const DensityPoint& point : layer.table) {
            require(within(point.density, 0, 1e6), "density in range");
        }
    }
}

inline void check_octaves(const NoiseOctaves& octaves) {
    require(!octaves.frequencies.empty() && octaves.frequencies.size() <= 16, "1 to 16 octaves");
    require(octaves.gains.size() == octaves.frequencies.size(), "one gain per octave");
    for (const auto& frequency : octaves.frequencies) {
        for (const int cells : frequency)
            require(cells >= 1 && cells <= 1048576, "frequency in range");
    }
    double sum = 0;
    for (const double gain : octaves.gains) {
        require(within(gain, 0, 1e10), "gain in range");
        sum += gain;
    }
    require(sum > 0, "octaves weigh something");
}

inline void check_channel(const NoiseChannel& channel) {
    if (channel.type == NoiseType::constant) {
        require(channel.octaves.frequencies.empty(), "a constant has no octaves");
    } else {
        check_octaves(channel.octaves);
    }
    if (channel.type == NoiseType::perlin_worley) check_octaves(channel.worley_octaves);
    require(within(channel.value, -1e6, 1e6), "value in range");
    for (const double bound : channel.remap) require(within(bound, -1e6, 1e6), "remap in range");
    require(std::fabs(channel.remap[1] - channel.remap[0]) >= 1e-6, "remap has a slope");
    require(within(channel.bias, 0.001, 0.999), "bias in range");
}

inline void check_noise(const Noise& noise) {
    std::string letters;
    for (const NoiseChannel& channel : noise.channels) {
        letters += channel.name;
        check_channel(channel);
    }
    require(letters == "Y" || letters == "R" || letters == "RGB" || letters == "RGBA",
            "channels of a picture");
    require(noise.pack != NoisePacking::shape || letters == "RGBA", "shape packs R, G, B, A");
    require(noise.pack != NoisePacking::detail || letters == "RGB", "detail packs R, G, B");
    for (const int voxels : noise.size) require(voxels >= 1 && voxels <= 16384, "size in range");
}

inline void check_asset(const NoiseVolumeBake& asset, const Parameters& parameters) {
    bool found = false;
    for (const Noise& noise : parameters.noises) found = found || noise.name == asset.noise;
    require(found, "its noise is there");
    double voxels = 1;
    for (const int edge : asset.size) {
        require(edge >= 1 && edge <= 16384, "size in range");
        voxels *= edge;
    }
    require(voxels <= 68719476736.0, "at most 2^36 voxels");
    require(!asset.formats.empty() && asset.formats.size() <= 3, "one to three formats");
    const bool unorm =
        asset.pixel_type == PixelType::unorm8 || asset.pixel_type == PixelType::unorm16;
    for (const VolumeFormat format : asset.formats) {
        require(!unorm || format == VolumeFormat::bin, "unorm in bin alone");
    }
    require(asset.columns >= 0 && asset.columns <= asset.size[2], "no more columns than slices");
    require(asset.mips >= 1 && asset.mips <= 15, "levels in range");
}

template <class Asset>
void check_asset(const Asset& asset, const Parameters& parameters) {
    require(parameters.atmosphere.ground_radius.meters > 0, "a sky has an atmosphere");
    if (asset.max_error) {
        require(within(*asset.max_error, 1e-7, 1), "max_error in range");
        return;
    }
    for (const int texels : asset.size) require(texels >= 1 && texels <= 16384, "size in range");
}

inline void check_atmosphere(const Parameters& parameters) {
    const std::size_t channels = parameters.wavelengths.size();
    const Atmosphere& atmosphere = parameters.atmosphere;
    require(within(atmosphere.ground_radius.meters, 1, 1e12), "ground radius in range");
    require(within(atmosphere.top_radius.meters, 1, 1e12), "top radius in range");
    require(atmosphere.top_radius.meters > atmosphere.ground_radius.meters, "top above ground");
    require(atmosphere.ground_albedo.size() == channels, "one albedo per channel");
    for (const double albedo : atmosphere.ground_albedo)
        require(within(albedo, 0, 1), "albedo in range");
    for (const Layer& layer : atmosphere.layers) check_layer(layer, channels);
}

inline void check_parameters(const Parameters& parameters) {
    const std::size_t channels = parameters.wavelengths.size();
    require(channels == 1 || channels == 3, "one channel or three");
    for (const Noise& noise : parameters.noises) check_noise(noise);
    for (const Bake& bake : parameters.bakes) {
        require(!bake.name.empty() && bake.name.find('/') == std::string::npos,
                "a name for a file");
        std::visit([&](const auto& asset) { check_asset(asset, parameters); }, bake.asset);
    }
    if (parameters.atmosphere.ground_radius.meters > 0) check_atmosphere(parameters);
}

inline std::string canonical_text(const Recipe& recipe) {
    const std::string patterns[] = {"*", "*.*", "*.*.*", "*.*.*.*", "*.*.*.*.*"};
    return parameters_toml(recipe, patterns);
}

// Either a recipe in range whose canonical text is a recipe of the same canonical text, or an
// error.
inline void check_outcome(const Outcome<Recipe>& outcome) {
    bool has_error = false;
    for (const Diagnostic& diagnostic : outcome.diagnostics) {
        require(!diagnostic.code.empty() && !diagnostic.message.empty(),
                "diagnostics say something");
        require(diagnostic.where.line >= 0 && diagnostic.where.column >= 0, "places are places");
        has_error = has_error || diagnostic.severity == Severity::error;
    }
    require(outcome.value.has_value() != has_error, "a value, or an error");
    if (!outcome.value) return;
    check_parameters(outcome.value->parameters);
    const std::string canonical = canonical_text(*outcome.value);
    const Outcome<Recipe> again = parse_recipe(canonical, "canonical.toml");
    require(again.value.has_value(), "canonical text is a recipe");
    require(canonical_text(*again.value) == canonical, "canonical text is stable");
}

}  // namespace skybake::config::fuzzing
