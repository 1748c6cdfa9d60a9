// Compares the light of an asset with paths of light. The result is the certificate's error.sky.
//
// With the same number of paths everywhere, twilight would be very noisy: places have paths in
// proportion to their relative spread. Then the places with the largest errors are traced again
// with more paths, until the place with the largest error is one of these: noise makes errors
// larger, and the largest most of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <vector>

#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct Baked;

// One place's light by paths.
struct TracedPlace {
    PathTracedRadiance light;
    std::int64_t paths = 0;
    bool again = false;  // it is one of the places of largest error, which were traced again
};

// The light of some places by paths, with which any number of lights found there are compared. The
// arguments must outlive it.
class SkyComparison {
  public:
    // `weights` make the colours of channels that are colours; none: channels are wavelengths.
    SkyComparison(const TracedLight& light, std::vector<glm::dvec3> weights,
                  const BakeOptions& options);

    // Traces all places with `most_paths` paths together, fewer where air scatters very often.
    void trace(double most_paths);
    // Traces the places again where what was found is off most, until the worst is one of these.
    void trace_worst(const std::vector<Spectrum>& found);

    const std::vector<TracedPlace>& places() const { return places_; }

    // Returns |found / traced - 1| over all places and channels (measure_sky).
    SkyError error(const std::vector<Spectrum>& found) const;

  private:
    PathTracedRadiance trace(std::size_t place, std::uint64_t seed, std::int64_t paths) const;
    void trace(const std::vector<std::size_t>& places, std::uint64_t seed);
    double scale_of(const PathTracedRadiance& traced, std::size_t channel) const;
    double spread_of(const PathTracedRadiance& pilot) const;
    void share_paths(double most_paths);
    struct CountedError;
    std::vector<CountedError> errors_of(std::size_t place, const Spectrum& found) const;
    bool is_trusted(const PathTracedRadiance& traced, std::size_t channel) const;
    int lit_channels(std::size_t place) const;
    std::vector<std::size_t> worst_places(const std::vector<Spectrum>& found) const;
    double mean_paths() const;

    const TracedLight& light_;
    const std::vector<glm::dvec3> weights_;
    const BakeOptions& options_;
    std::vector<TracedPlace> places_;
};

// Returns |found / traced - 1| over all places and channels; of colours, whose channels may be 0 or
// below, the difference over the brightest channel. Channels where no path finds light do not count,
// and those whose standard error is above 5 % are left out. After an interruption the result must
// not be used.
SkyError measure_sky(const TracedLight& light, const Baked& baked, const BakeOptions& options);

}  // namespace skybake
