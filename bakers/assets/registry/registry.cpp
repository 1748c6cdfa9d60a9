#include "bakers/assets/registry/registry.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/sky_comparison.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/baked.h"
#include "bakers/math/bake_clock.h"
#include "config/assets/asset_kind.h"
#include "config/assets/assets.h"
#include "config/sections/frames.h"
#include "config/sections/layer.h"
#include "config/text/key_path.h"

namespace skybake {
namespace {

// Calls make(parameters) with those that a bake is made from: a packet has its own wavelengths only,
// and a frame its own time.
template <class Make>
auto with_own_parameters(const Parameters& parameters, const Bake& bake, const Make& make) {
    const int frame = config::frame_of(parameters, bake);
    if (frame > 0) return make(config::at_frame(parameters, frame));
    const int packet = config::packet_number(bake);
    return packet == 0 ? make(parameters) : make(config::packet_of(parameters, packet));
}

// Whether an asset holds light, which becomes colours. What multiplies light has none of its own.
bool has_colors(const Bake& bake) {
    const config::UseOfLight use = config::kind_of(bake).facts.use_of_light;
    return use == config::UseOfLight::channels || use == config::UseOfLight::colors;
}

bool scatters(const config::Layer& layer) {
    return layer.phase == config::Phase::mie ||
           std::ranges::any_of(layer.scattering,
                               [](const config::InverseLength& one) { return one.per_meter > 0; });
}

// Returns what the light of a packet is compared with, which keeps the packet's parameters.
template <class Asset>
std::optional<TracedLight> light_of_packet(const Baker<Asset>& baker, const Parameters& parameters,
                                           const Bake& bake) {
    const int packet = config::packet_number(bake);
    if (packet == 0) return baker.traced(parameters, bake.as<Asset>());
    const auto own = std::make_shared<const Parameters>(config::packet_of(parameters, packet));
    std::optional<TracedLight> light = baker.traced(*own, bake.as<Asset>());
    if (light) {
        light->found = [own, found = std::move(light->found)](const Baked& baked, int threads) {
            return found(baked, threads);
        };
    }
    return light;
}

// Makes a function of any bake, with the parameters of its packet, from one of its baker.
template <class Asset, class Result, class... More>
auto of_any_bake(Result (*function)(const Parameters&, const Asset&, More...)) {
    return [function](const Parameters& parameters, const Bake& bake, More... more) {
        return with_own_parameters(parameters, bake, [&](const Parameters& own) {
            return function ? function(own, bake.as<Asset>(), std::forward<More>(more)...)
                            : Result();
        });
    };
}

template <class Asset>
AnyBaker any_baker(std::string_view asset, const Baker<Asset>& baker) {
    AnyBaker any;
    any.asset = asset;
    any.version = baker.version;
    any.variants = baker.variants;
    any.inputs = [baker](const Parameters& parameters, const Bake& bake) {
        return baker.inputs ? baker.inputs(parameters, bake.as<Asset>()) : std::vector<InputFile>{};
    };
    any.estimate = of_any_bake(baker.estimate);
    any.needs = [own_needs = of_any_bake(baker.needs)](
                    const Parameters& parameters, const Bake& bake, Certification certification) {
        std::vector<Need> needs = own_needs(parameters, bake, certification);
        if (has_colors(bake)) {
            for (Need& need : color_needs(parameters)) needs.push_back(std::move(need));
        }
        return needs;
    };
    any.places = of_any_bake(baker.places);
    any.lookup = of_any_bake(baker.lookup);
    any.traced = [baker](const Parameters& parameters, const Bake& bake) {
        std::optional<TracedLight> light =
            baker.traced ? light_of_packet(baker, parameters, bake) : std::nullopt;
        const auto& layers = parameters.atmosphere.layers;
        if (light) light->air_scatters = std::ranges::any_of(layers, scatters);
        return light;
    };
    any.draft = [baker](Bake& bake, int most_voxels) {
        if (baker.draft) baker.draft(bake.as<Asset>(), most_voxels);
    };
    any.bake = of_any_bake(baker.bake);
    return any;
}

}  // namespace

void add_recipe_place(const Recipe& recipe, const Bake& bake, Diagnostic& diagnostic) {
    if (!diagnostic.where.source.empty()) return;
    const std::string section = config::join_path("bake", bake.name);
    for (const config::ResolvedValue& value : recipe.values) {
        if (value.section != section) continue;
        const config::SourceRange place = recipe_place(value);
        if (place.source.empty()) continue;
        const bool is_named = value.path == config::join_path(section, diagnostic.key);
        const bool is_first = diagnostic.where.source.empty() || place.line < diagnostic.where.line;
        if (is_named || is_first) diagnostic.where = place;
        if (is_named) return;
    }
}

namespace {

// Says how the wavelengths of an asset of light become colours. An interrupted bake has no value.
void add_colors(const Parameters& parameters, const Bake& bake, const BakeOptions& options,
                std::optional<Baked>& baked) {
    if (!baked || !has_colors(bake)) return;
    const std::shared_ptr<const SkyColors> colors = colors_of(parameters, options);
    if (options.cancelled()) baked.reset();
    if (!colors || !baked) return;
    const config::PacketRange own = config::packet_range(parameters, config::packet_number(bake));
    baked->conventions.color = color_convention(
        *parameters.color, std::span(colors->weights).subspan(own.first, own.count),
        config::kind_of(bake).facts.use_of_light == config::UseOfLight::colors &&
            holds_colors(parameters));
    if (baked->certified) baked->certificate.color = colors->error;
}

// Adds error.sky. An interrupted bake has no value.
void compare_with_paths(const AnyBaker& baker, const Parameters& parameters, const Bake& bake,
                        const BakeOptions& options, std::optional<Baked>& baked) {
    if (!baked || !baked->certified) return;
    const std::optional<TracedLight> light = baker.traced(parameters, bake);
    if (!light) return;
    const BakeTime time(BakePart::certificate);
    SkyError error = measure_sky(*light, *baked, options);
    if (options.cancelled()) {
        baked.reset();
    } else if (error.points + error.left_out > 0) {
        // Where nothing scatters there is no sky to be off.
        constexpr double kFar = 0.1;
        std::string& advice = baked->certificate.advice;
        if (error.median > kFar && advice.empty()) advice = error.better;
        baked->certificate.sky = std::move(error);
    }
}

}  // namespace

config::SourceRange recipe_place(const config::ResolvedValue& value) {
    config::SourceRange place;
    const std::size_t colon = value.origin.rfind(':');
    if (colon == std::string::npos) return place;
    const char* const end = value.origin.data() + value.origin.size();
    const auto read = std::from_chars(value.origin.data() + colon + 1, end, place.line);
    if (read.ec != std::errc{} || read.ptr != end) return {};
    place.source = value.origin.substr(0, colon);
    return place;
}

std::span<const AnyBaker> bakers() {
    static const std::vector<AnyBaker> all = [] {
        std::vector<AnyBaker> found;
        config::for_each_asset([&found]<class Asset>(config::Tag<Asset> asset) {
            found.push_back(any_baker(asset_kind(asset).facts.name, baker(BakerTag<Asset>{})));
        });
        return found;
    }();
    return all;
}

const AnyBaker& baker_of(const Bake& bake) {
    const std::string_view name = config::kind_of(bake).facts.name;
    return *std::ranges::find(bakers(), name, &AnyBaker::asset);
}

std::vector<Need> needs_of(const Parameters& parameters, std::span<const Bake> bakes,
                           Certification certification) {
    std::vector<Need> needs;
    for (const Bake& bake : bakes) {
        std::vector<Need> own = baker_of(bake).needs(parameters, bake, certification);
        std::ranges::move(own, std::back_inserter(needs));
    }
    return needs;
}

std::string asset_parameters(const Recipe& recipe, const Bake& bake) {
    std::vector<config::Read> reads = config::kind_of(bake).reads(recipe.parameters, bake);
    reads.push_back({config::join_path("bake", bake.name), config::Roles::all()});
    return config::parameters_toml(recipe, reads);
}

std::vector<Diagnostic> check_air(const Recipe& recipe) {
    std::vector<Diagnostic> faults;
    for (const Bake& bake : recipe.parameters.bakes) {
        auto fault = check_solvable(recipe.parameters.atmosphere, bake);
        if (!fault) continue;
        add_recipe_place(recipe, bake, *fault);
        faults.push_back(std::move(*fault));
    }
    return faults;
}

Outcome<Baked> bake_asset(const Recipe& recipe, const Bake& bake, const BakeOptions& options) {
    std::vector<Diagnostic> problems = check_particles(recipe.parameters);
    if (!problems.empty()) return {{}, std::move(problems)};
    if (auto fault = check_solvable(recipe.parameters.atmosphere, bake)) {
        add_recipe_place(recipe, bake, *fault);
        return std::move(*fault);
    }
    const AnyBaker& baker = baker_of(bake);
    AssetLabel label;
    label.name = bake.name;
    label.parameters = asset_parameters(recipe, bake);
    label.details.emplace_back("baker_version", static_cast<double>(baker.version));
    Outcome<Baked> outcome = baker.bake(recipe.parameters, bake, options, std::move(label));
    add_colors(recipe.parameters, bake, options, outcome.value);
    compare_with_paths(baker, recipe.parameters, bake, options, outcome.value);
    if (outcome.value) {
        for (Diagnostic& warning : warn_of_large_errors(recipe.parameters, *outcome.value)) {
            outcome.diagnostics.push_back(std::move(warning));
        }
    }
    for (Diagnostic& found : outcome.diagnostics) add_recipe_place(recipe, bake, found);
    return outcome;
}

}  // namespace skybake
