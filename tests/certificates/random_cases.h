// Random legal atmospheres, cameras and sizes: the same ones in every run, on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "config/sections/atmosphere.h"
#include "config/sections/layer.h"

namespace skybake::test {

class RandomCase {
  public:
    explicit RandomCase(std::uint64_t seed) : engine_(seed) {}

    double uniform(double from, double to) {
        return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    double log_uniform(double from, double to) {
        return std::exp(uniform(std::log(from), std::log(to)));
    }
    int below(int count) { return static_cast<int>(uniform(0, 1) * count); }
    int even(int from, int to) { return 2 * static_cast<int>(log_uniform(from, to) / 2); }

    // One to three layers of any closed phase function and any profile, with zenith optical depths
    // from 1e-3 to 3, around a planet of 500 km to 20000 km.
    config::Atmosphere atmosphere() {
        const double radius = log_uniform(5e5, 2e7);
        const double thickness = radius * log_uniform(4e-3, 0.1);
        config::Atmosphere atmosphere;
        atmosphere.ground_radius = {radius};
        atmosphere.top_radius = {radius + thickness};
        atmosphere.ground_albedo = {uniform(0, 1), uniform(0, 1), uniform(0, 1)};
        const int layers = 1 + below(3);
        for (int i = 0; i < layers; ++i) {
            atmosphere.layers.push_back(
                layer(thickness, std::string(1, static_cast<char>('a' + i))));
        }
        return atmosphere;
    }

  private:
    config::Layer layer(double thickness, std::string name) {
        config::Layer layer;
        layer.name = std::move(name);
        layer.profile = static_cast<config::Profile>(below(4));
        layer.scale_height = {thickness * log_uniform(0.03, 0.3)};
        layer.center_altitude = {thickness * uniform(0.1, 0.6)};
        layer.half_width = {thickness * uniform(0.05, 0.4)};
        layer.bottom_altitude = {thickness * uniform(0, 0.3)};
        layer.top_altitude = {thickness * uniform(0.35, 0.9)};
        for (int i = 0; i < 4; ++i) {
            layer.table.push_back({{thickness * 0.3 * i}, i == 3 ? 0 : uniform(0.1, 1)});
        }
        layer.phase = static_cast<config::Phase>(below(4));
        layer.g = uniform(-0.5, 0.85);
        layer.extinction.assign(3, {1});
        const double column = config::density_column(layer, {thickness});
        const double depth = log_uniform(1e-3, 3);
        const double albedo = uniform(0, 1);
        layer.extinction.clear();
        for (int c = 0; c < 3; ++c) {
            const double extinction = depth * log_uniform(0.4, 2.5) / column;
            layer.extinction.push_back({extinction});
            layer.scattering.push_back({extinction * std::min(1.0, albedo * uniform(0.8, 1.2))});
        }
        return layer;
    }

    std::mt19937_64 engine_;
};

}  // namespace skybake::test
