#include "bakers/field/make_probe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/field/bilinear.h"
#include "bakers/math/low_discrepancy.h"

namespace skybake {

namespace {

ProbedTexture probed_texture(const Image2<float>& image, config::PixelType type) {
    ProbedTexture texture;
    texture.texture = readable_texture(image);
    texture.dimensions = 2;
    texture.type = type;
    const auto channels = static_cast<std::size_t>(image.channels);
    texture.largest.assign(channels, 0);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        double& largest = texture.largest[i % channels];
        largest = std::max(largest, std::fabs(double{image.texels[i]}));
    }
    return texture;
}

// By the lookup that readers of probes are given.
Probe table_probe(const Image2<float>& image, const std::array<double, 2>& uv, ProbeValue value) {
    Probe probe;
    probe.uv = uv;
    probe.value = std::move(value.value);
    probe.tolerance = std::move(value.tolerance);
    bilinear(image, uv[0], uv[1], probe.value.data());
    return probe;
}

// The places of table `part` of `parts` that are one below the other.
ProbePlaces below_each_other(ProbePlaces place, int part, int parts) {
    return [place = std::move(place), part, parts](const std::array<double, 3>& wanted) {
        ProbePlace result = place(wanted);
        for (ProbeLookup& lookup : result.lookups) {
            lookup.uvw[1] = (part + lookup.uvw[1]) / parts;
        }
        return result;
    };
}

// Of probes of a table, and of each table of several.
constexpr int kTableProbes = 24;
constexpr int kProbesOfPart = 12;

}  // namespace

ReadableTexture readable_texture(const Image2<float>& image) {
    ReadableTexture texture;
    texture.use.size = {image.width, image.height, 1};
    texture.channels = static_cast<std::size_t>(image.channels);
    texture.read = [&image](const std::array<VoxelTap, 8>& taps, float* values) {
        for (const VoxelTap& tap : taps) {
            values = std::copy_n(image.texel(tap.voxel[0], tap.voxel[1]), image.channels, values);
        }
    };
    return texture;
}

Probe make_probe(const Image2<float>& image, double u, double v, config::PixelType type) {
    return table_probe(image, {u, v}, probe_value(probed_texture(image, type), {{{u, v, 0.5}}}));
}

ProbeSpace table_space(const TableModel& model, std::array<int, 2> size,
                       std::function<Place(double x, double y)> place_of) {
    // Corners, edges, the middle, and places between texels about them, before those that are
    // spread evenly.
    static const std::vector<std::array<double, 3>> kFirst = {
        {0, 0},          {1, 0},          {0, 1},          {1, 1},         {0.5, 0},
        {0.5, 1},        {0, 0.5},        {1, 0.5},        {0.5, 0.5},     {0.25, 0.125},
        {0.75, 0.125},   {0.981, 0.0131}, {0.996, 0.0041}, {0.4871, 0.02}, {0.5129, 0.02},
        {0.4613, 0.297}, {0.6173, 0.711}, {0.873, 0.5491}, {0.127, 0.867}, {0.968, 0.871}};
    constexpr int kPlaces = 256;
    ProbeSpace space;
    space.wanted = kFirst;
    for (const PointRow& point : low_discrepancy_points(kPlaces, 1)) {
        space.wanted.push_back({point.x.front(), point.y, 0});
    }
    space.place = [model, size,
                   place_of = std::move(place_of)](const std::array<double, 3>& wanted) {
        std::array<double, 2> xy = {wanted[0], wanted[1]};
        if (model.probe_place) xy = model.probe_place(xy[0], xy[1]);
        return ProbePlace{
            place_of(xy[0], xy[1]),
            {{{lookup_u(model, xy[0], size[0]), lookup_v(model, xy[1], size[1]), 0.5}}}};
    };
    return space;
}

std::optional<config::Diagnostic> add_probes(std::vector<ProbeSpace> spaces,
                                             const BakeOptions& options, BakedTable& table) {
    const auto parts = static_cast<int>(spaces.size());
    for (int part = 0; part < parts; ++part) {
        ProbePlaces& place = spaces[static_cast<std::size_t>(part)].place;
        place = below_each_other(std::move(place), part, parts);
    }
    ProbeSet set = take_probes(probed_texture(table.image, table.pixel_type), spaces,
                               std::max(kTableProbes, kProbesOfPart * parts), options);
    if (const auto problem = weak_probes(table.name, set)) return problem;
    table.probes.clear();
    for (TakenProbe& taken : set.probes) {
        const std::array<double, 3>& uvw = taken.place.lookups.front().uvw;
        Probe probe = table_probe(table.image, {uvw[0], uvw[1]}, std::move(taken.value));
        probe.at = std::move(taken.place.at);
        table.probes.push_back(std::move(probe));
    }
    table.catches = std::move(set.catches);
    return std::nullopt;
}

}  // namespace skybake
