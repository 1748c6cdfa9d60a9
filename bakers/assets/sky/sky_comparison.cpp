#include "bakers/assets/sky/sky_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "bakers/field/finish_table.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

// Paths in all places together. The first number takes about as long as Earth's solution. In air
// that scatters light very often there are fewer, so that they have at most so many flights.
constexpr double kQuickPaths = 3 << 16;
constexpr double kFullPaths = 1 << 20;
constexpr double kMostFlightsOfPath = 32;
constexpr std::int64_t kPilotPaths = 64;
constexpr double kMostPathsOfMean = 16;
// The places of largest error are traced again with so many times the mean of paths, and with twice
// their own at least.
constexpr std::int64_t kPathsAgain = 8;
constexpr std::size_t kPlacesAgain = 4;
constexpr int kMostRounds = 3;
// Pilot paths find the spread and the cost of each place. They and the paths of each round have
// seeds of their own.
constexpr std::uint64_t kPilotSeed = 100;

// Paths with rare, bright light find too little of it until one of them has found it: a larger
// standard error tells little, itself included. The second bound is of the light that paths found
// alone, without what quadrature adds to it: paths that found none of it have no standard error.
constexpr double kLargestSpread = 0.05;
constexpr double kLargestSpreadOfWalked = 0.25;

// The colours that the weights make of the light of all packets.
PathTracedRadiance in_colors(const std::vector<PathTracedRadiance>& packets,
                             const std::vector<glm::dvec3>& weights) {
    PathTracedRadiance sum;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const PathTracedRadiance& packet = packets[i / kMaxChannels];
        const std::size_t c = i % kMaxChannels;
        const Spectrum weight(weights[i], 0);
        sum.radiance += packet.radiance[c] * weight;
        sum.walked += packet.walked[c] * weight;
        for (std::size_t r = 0; r < kPathReplicates; ++r) {
            sum.replicates[r] += packet.replicates[r][c] * weight;
        }
    }
    for (const PathTracedRadiance& packet : packets) sum.flights += packet.flights;
    sum.standard_error = standard_error_of(sum.replicates, sum.walked);
    return sum;
}

// The sun's elevation at a place, in degrees, or none if the place does not say it.
std::optional<double> sun_of(const Place& place) {
    for (const auto& [quantity, value] : place) {
        if (quantity == "sun_elevation_deg") return value;
    }
    return std::nullopt;
}

}  // namespace

// An error that counts, and its standard error.
struct SkyComparison::CountedError {
    double error = 0;
    double standard_error = 0;
};

SkyComparison::SkyComparison(const TracedLight& light, std::vector<glm::dvec3> weights,
                             const BakeOptions& options)
    : light_(light),
      weights_(std::move(weights)),
      options_(options),
      places_(light.places.size()) {}

void SkyComparison::trace(double most_paths) {
    share_paths(most_paths);
    std::vector<std::size_t> all(places_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    trace(all, 0);
}

void SkyComparison::trace_worst(const std::vector<Spectrum>& found) {
    const auto again_paths = kPathsAgain * static_cast<std::int64_t>(mean_paths());
    for (int round = 1; round <= kMostRounds && !options_.cancelled(); ++round) {
        const std::vector<std::size_t> worst = worst_places(found);
        if (worst.empty() || places_[worst.front()].again) return;
        std::vector<std::size_t> again;
        for (const std::size_t i : worst) {
            if (places_[i].again) continue;
            places_[i].again = true;
            places_[i].paths = std::max(again_paths, 2 * places_[i].paths);
            again.push_back(i);
        }
        trace(again, static_cast<std::uint64_t>(round));
    }
}

SkyError SkyComparison::error(const std::vector<Spectrum>& found) const {
    SkyError result;
    std::vector<double> errors;
    std::vector<double> spreads;
    double largest = -1;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::vector<CountedError> counted = errors_of(i, found[i]);
        result.left_out += lit_channels(i) - static_cast<int>(counted.size());
        for (const CountedError& one : counted) {
            errors.push_back(one.error);
            spreads.push_back(one.standard_error);
            if (one.error <= largest) continue;
            largest = one.error;
            result.worst = place_text(light_.places[i]);
            result.worst_sun_deg = sun_of(light_.places[i]);
        }
    }
    result.better = light_.better;
    result.points = static_cast<int>(errors.size());
    result.reference = fmt::format("{:.0f} paths of light in each of {} places in the mean",
                                   mean_paths(), places_.size());
    if (errors.empty()) return result;
    std::ranges::sort(errors);
    std::ranges::sort(spreads);
    result.median = errors[errors.size() / 2];
    result.ninth_decile = errors[errors.size() * 9 / 10];
    result.max = errors.back();
    result.standard_error = spreads[spreads.size() / 2];
    return result;
}

PathTracedRadiance SkyComparison::trace(std::size_t place, std::uint64_t seed,
                                        std::int64_t paths) const {
    PathTracerSettings settings;
    settings.seed = seed;
    settings.ray = static_cast<std::uint32_t>(place);
    settings.paths = paths;
    if (weights_.empty()) return light_.traced.front()(place, settings);
    std::vector<PathTracedRadiance> packets;
    for (const TraceOfPlace& traced : light_.traced) {
        packets.push_back(traced(place, settings));
        settings.ray += static_cast<std::uint32_t>(places_.size());
    }
    return in_colors(packets, weights_);
}

// Returns what errors of a channel are relative to: its light, or in colours, of which one channel
// may be nearly 0 or below, the brightest channel.
double SkyComparison::scale_of(const PathTracedRadiance& traced, std::size_t channel) const {
    return weights_.empty() ? traced.radiance[channel] : largest(traced.radiance);
}

void SkyComparison::trace(const std::vector<std::size_t>& places, std::uint64_t seed) {
    for_each_tile(static_cast<int>(places.size()), options_, "tracing paths", [&](int i) {
        const std::size_t place = places[static_cast<std::size_t>(i)];
        places_[place].light = trace(place, seed, places_[place].paths);
    });
}

// The RMS over channels of the standard error over the light.
double SkyComparison::spread_of(const PathTracedRadiance& pilot) const {
    double squares = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(light_.channels); ++c) {
        const double scale = scale_of(pilot, c);
        if (!(scale > 0)) continue;
        const double spread = pilot.standard_error[c] / scale;
        squares += spread * spread;
    }
    return std::sqrt(squares / light_.channels);
}

void SkyComparison::share_paths(double most_paths) {
    std::vector<PathTracedRadiance> pilots(places_.size());
    for_each_tile(static_cast<int>(places_.size()), options_, "tracing paths", [&](int i) {
        pilots[static_cast<std::size_t>(i)] =
            trace(static_cast<std::size_t>(i), kPilotSeed, kPilotPaths);
    });
    double flights = 0;
    double spreads = 0;
    for (const PathTracedRadiance& pilot : pilots) {
        flights += spread_of(pilot) * pilot.flights;
        spreads += spread_of(pilot);
    }
    const double all =
        spreads > 0 ? most_paths * std::min(kMostFlightsOfPath * spreads / flights, 1.0) : 0;
    const double most_of_place = kMostPathsOfMean * all / static_cast<double>(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const double share = spreads > 0 ? spread_of(pilots[i]) / spreads : 0;
        const double paths = std::min(share * all, most_of_place);
        places_[i].paths = std::max(static_cast<std::int64_t>(paths), kPilotPaths);
    }
}

std::vector<SkyComparison::CountedError> SkyComparison::errors_of(std::size_t place,
                                                                  const Spectrum& found) const {
    std::vector<CountedError> counted;
    const PathTracedRadiance& traced = places_[place].light;
    for (std::size_t c = 0; c < static_cast<std::size_t>(light_.channels); ++c) {
        const double scale = scale_of(traced, c);
        if (!(scale > 0)) continue;
        double error = weights_.empty() ? std::fabs(found[c] / scale - 1)
                                        : std::fabs(found[c] - traced.radiance[c]) / scale;
        if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
        if (!is_trusted(traced, c)) continue;
        counted.push_back({error, traced.standard_error[c] / scale});
    }
    return counted;
}

// False where too few paths found light for their standard error to mean anything. In air that
// does not scatter paths have nothing to find.
bool SkyComparison::is_trusted(const PathTracedRadiance& traced, std::size_t channel) const {
    if (!light_.air_scatters) return true;
    const double error = traced.standard_error[channel];
    const double walked = weights_.empty() ? traced.walked[channel] : largest(traced.walked);
    return walked > 0 && error <= kLargestSpread * scale_of(traced, channel) &&
           error <= kLargestSpreadOfWalked * walked;
}

int SkyComparison::lit_channels(std::size_t place) const {
    int lit = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(light_.channels); ++c) {
        if (scale_of(places_[place].light, c) > 0) ++lit;
    }
    return lit;
}

// The places with the largest errors, the worst one first.
std::vector<std::size_t> SkyComparison::worst_places(const std::vector<Spectrum>& found) const {
    std::vector<std::pair<double, std::size_t>> by_error;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        double largest = 0;
        for (const CountedError& one : errors_of(i, found[i]))
            largest = std::max(largest, one.error);
        if (largest > 0) by_error.emplace_back(-largest, i);
    }
    std::ranges::sort(by_error);
    std::vector<std::size_t> worst;
    for (std::size_t i = 0; i < std::min(by_error.size(), kPlacesAgain); ++i) {
        worst.push_back(by_error[i].second);
    }
    return worst;
}

double SkyComparison::mean_paths() const {
    double sum = 0;
    for (const TracedPlace& place : places_) sum += static_cast<double>(place.paths);
    return places_.empty() ? 0 : sum / static_cast<double>(places_.size());
}

SkyError measure_sky(const TracedLight& light, const Baked& baked, const BakeOptions& options) {
    SkyComparison comparison(light, weights_of(baked.conventions), options);
    comparison.trace(options.certification == Certification::full ? kFullPaths : kQuickPaths);
    const std::vector<Spectrum> found = light.found(baked, options.threads);
    comparison.trace_worst(found);
    return comparison.error(found);
}

}  // namespace skybake
