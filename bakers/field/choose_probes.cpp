#include "bakers/field/choose_probes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "bakers/field/pixel_type.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

// A wrong lookup shows if it is off by more than kShows tolerances. More than kPlenty tolerances
// count as kPlenty.
constexpr double kShows = 2;
constexpr double kPlenty = 16;

// Probes are taken until each wrong lookup shows at this many of them.
constexpr int kWantedProbes = kSeveralProbes + 1;

// If necessary, every texel of a texture with at most kMostTexels texels is tried. In a texture with at
// most kFewTexels all places are candidates then, in a larger one those that are needed.
constexpr std::int64_t kFewTexels = 4096;
constexpr std::int64_t kMostTexels = 131072;

struct ProbeCandidate {
    std::size_t space = 0;
    std::array<double, 3> wanted{};
    ProbePlace place;
    ProbeValue value;
    std::vector<double> off;  // by how many tolerances, one per wrong lookup
    bool taken = false;
};

// Keeps a memo of what was read, because lookups around one place share their texels.
ReadableTexture remembering(const ReadableTexture& texture) {
    using Key = std::array<std::array<int, 3>, 2>;
    auto known = std::make_shared<std::map<Key, std::vector<float>>>();
    ReadableTexture result = texture;
    result.read = [texture, known](const std::array<VoxelTap, 8>& taps, float* values) {
        std::vector<float>& kept = (*known)[{taps[0].voxel, taps[7].voxel}];
        if (kept.empty()) {
            kept.resize(8 * texture.channels);
            texture.read(taps, kept.data());
        }
        std::ranges::copy(kept, values);
    };
    return result;
}

// Adds the largest change that filtering in steps of 1/256 texel can cause: the place moves by less
// than one step along each axis.
void add_filtering(const ReadableTexture& texture, const ProbeLookup& lookup,
                   std::vector<double>& tolerance) {
    std::vector<double> exact(texture.channels, 0.0);
    add_lookup(texture, texture.use, lookup.uvw, 1, exact);
    std::vector<double> farthest(texture.channels, 0.0);
    for (unsigned step = 0; step < 8; ++step) {
        std::array<double, 3> moved = lookup.uvw;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double sign = (step >> axis) % 2 == 0 ? -1 : 1;
            moved[axis] += sign / 256 / texture.use.size[axis];
        }
        std::vector<double> found(texture.channels, 0.0);
        add_lookup(texture, texture.use, moved, 1, found);
        for (std::size_t c = 0; c < found.size(); ++c) {
            farthest[c] = std::max(farthest[c], std::fabs(found[c] - exact[c]));
        }
    }
    for (std::size_t c = 0; c < farthest.size(); ++c) tolerance[c] += lookup.share * farthest[c];
}

// The error in tolerances, of the channel where it is largest.
double tolerances_off(const std::vector<double>& found, const ProbeValue& probe) {
    double most = 0;
    for (std::size_t c = 0; c < found.size(); ++c) {
        most = std::max(most, std::fabs(found[c] - probe.value[c]) / probe.tolerance[c]);
    }
    return most;
}

void measure_candidate(const ProbedTexture& probed, const std::vector<WrongLookup>& wrongs,
                       ProbeCandidate& candidate) {
    ProbedTexture near = probed;
    near.texture = remembering(probed.texture);
    const std::vector<ProbeLookup>& lookups = candidate.place.lookups;
    candidate.value = probe_value(near, lookups);
    for (const WrongLookup& wrong : wrongs) {
        candidate.off.push_back(
            tolerances_off(look_up_wrongly(near.texture, lookups, wrong), candidate.value));
    }
}

void measure_candidates(std::size_t first, const ProbedTexture& texture,
                        const std::vector<WrongLookup>& wrongs, const BakeOptions& options,
                        std::vector<ProbeCandidate>& candidates) {
    constexpr std::size_t kTile = 16;
    const std::size_t count = candidates.size() - first;
    for_each_tile(static_cast<int>((count + kTile - 1) / kTile), options, "probes", [&](int tile) {
        const std::size_t begin = first + static_cast<std::size_t>(tile) * kTile;
        for (std::size_t i = begin; i < std::min(candidates.size(), begin + kTile); ++i) {
            measure_candidate(texture, wrongs, candidates[i]);
        }
    });
}

int places_that_show(const std::vector<ProbeCandidate>& candidates, std::size_t wrong) {
    return static_cast<int>(std::ranges::count_if(
        candidates, [wrong](const ProbeCandidate& at) { return at.off[wrong] > kShows; }));
}

ProbeCandidate candidate_at(const std::vector<ProbeSpace>& spaces, std::size_t space,
                            const std::array<double, 3>& wanted) {
    ProbeCandidate candidate;
    candidate.space = space;
    candidate.wanted = wanted;
    candidate.place = spaces[space].place(wanted);
    return candidate;
}

// Returns more places around those where a wrong lookup shows, if it shows at few places.
std::vector<ProbeCandidate> places_about(const std::vector<ProbeCandidate>& candidates,
                                         std::size_t wrongs, const std::vector<ProbeSpace>& spaces,
                                         const TextureUse& use) {
    std::vector<bool> alone(candidates.size(), false);
    for (std::size_t wrong = 0; wrong < wrongs; ++wrong) {
        if (places_that_show(candidates, wrong) >= kWantedProbes) continue;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (candidates[i].off[wrong] > kShows) alone[i] = true;
        }
    }
    std::vector<ProbeCandidate> more;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (!alone[i]) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const double by : {-0.5, -0.125, 0.125, 0.5}) {
                std::array<double, 3> near = candidates[i].wanted;
                near[axis] = std::clamp(near[axis] + by / use.size[axis], 0.0, 1.0);
                more.push_back(candidate_at(spaces, candidates[i].space, near));
            }
        }
    }
    return more;
}

// Returns the wrong lookups that show, but at few places.
std::vector<std::size_t> shown_at_few(const std::vector<ProbeCandidate>& candidates,
                                      std::size_t wrongs) {
    std::vector<std::size_t> few;
    for (std::size_t wrong = 0; wrong < wrongs; ++wrong) {
        const int places = places_that_show(candidates, wrong);
        if (places > 0 && places < kSeveralProbes) few.push_back(wrong);
    }
    return few;
}

std::int64_t texels_of(const TextureUse& use) {
    return std::int64_t{use.size[0]} * use.size[1] * use.size[2];
}

// Calls use_row(candidates) with the places a quarter of a texel to either side of every texel's
// centre, row by row.
template <class UseRow>
void for_each_row_of_texels(const std::vector<ProbeSpace>& spaces, const TextureUse& use,
                            int dimensions, const UseRow& use_row) {
    std::array<int, 3> places{};
    for (std::size_t axis = 0; axis < 3; ++axis) places[axis] = 2 * use.size[axis];
    if (dimensions == 2) places[2] = 1;
    places[1] /= static_cast<int>(spaces.size());  // one below the other
    for (std::size_t space = 0; space < spaces.size(); ++space) {
        for (int row = 0; row < places[1] * places[2]; ++row) {
            std::vector<ProbeCandidate> candidates;
            for (int x = 0; x < places[0]; ++x) {
                candidates.push_back(
                    candidate_at(spaces, space,
                                 {(x + 0.5) / places[0], (row % places[1] + 0.5) / places[1],
                                  (row / places[1] + 0.5) / places[2]}));
            }
            use_row(std::move(candidates));
        }
    }
}

// Drops candidates from `first` on at which none of some wrong lookups shows.
void keep_what_shows(const std::vector<std::size_t>& wrongs, std::size_t first,
                     std::vector<ProbeCandidate>& candidates) {
    const auto shows_none = [&wrongs](const ProbeCandidate& at) {
        return std::ranges::none_of(wrongs,
                                    [&at](std::size_t wrong) { return at.off[wrong] > kShows; });
    };
    const auto from = candidates.begin() + static_cast<std::ptrdiff_t>(first);
    candidates.erase(std::remove_if(from, candidates.end(), shows_none), candidates.end());
}

// Chooses probes from the candidates one by one.
class ProbeTaking {
  public:
    ProbeTaking(std::vector<ProbeCandidate>& candidates, std::size_t wrongs, int share)
        : candidates_(candidates), wanted_(wrongs) {
        for (std::size_t wrong = 0; wrong < wrongs; ++wrong) {
            wanted_[wrong] = std::min(kWantedProbes, places_that_show(candidates, wrong));
        }
        // Most probes of a space lie where the texture is not 0: `zeros` is the first wrong lookup.
        wanted_[0] = std::min(share - share / 4, places_that_show(candidates, 0));
        shows_.assign(wanted_.begin(), wanted_.end());
    }

    // Takes the candidate that shows the most wrong lookups of those still wanted, until none is
    // wanted.
    void take_what_is_wanted() {
        const auto gain = [this](const ProbeCandidate& at) {
            double sum = 0;
            for (std::size_t wrong = 0; wrong < wanted_.size(); ++wrong) {
                if (wanted_[wrong] > 0 && at.off[wrong] > kShows) sum += clamped(at.off[wrong]);
            }
            return sum;
        };
        while (take_best(gain, 0)) {
        }
    }

    // Takes candidates until `count` are taken, of one space or in all.
    void fill_up(int count, std::optional<std::size_t> space = {}) {
        const auto counts = [space](const ProbeCandidate& at) {
            return !space || at.space == *space;
        };
        const auto gain = [&counts](const ProbeCandidate& at) {
            if (!counts(at)) return -1.0;
            double sum = 0;
            for (const double off : at.off) sum += clamped(off);
            return sum;
        };
        const auto taken = [&] {
            return std::ranges::count_if(candidates_, [&counts](const ProbeCandidate& at) {
                return at.taken && counts(at);
            });
        };
        while (taken() < count && take_best(gain, -1)) {
        }
    }

    // Whether a wrong lookup shows anywhere.
    bool shows(std::size_t wrong) const { return shows_[wrong] > 0; }

  private:
    static double clamped(double off) { return std::min(off, kPlenty); }

    template <class Gain>
    bool take_best(const Gain& gain, double more_than) {
        ProbeCandidate* best = nullptr;
        double most = more_than;
        for (ProbeCandidate& candidate : candidates_) {
            if (candidate.taken) continue;
            const double gained = gain(candidate);
            if (gained <= most) continue;
            most = gained;
            best = &candidate;
        }
        if (best == nullptr) return false;
        best->taken = true;
        for (std::size_t wrong = 0; wrong < wanted_.size(); ++wrong) {
            if (best->off[wrong] > kShows) --wanted_[wrong];
        }
        return true;
    }

    std::vector<ProbeCandidate>& candidates_;
    std::vector<int> wanted_;  // per wrong lookup: so many more
    std::vector<int> shows_;
};

void add_name(const std::string& name, std::vector<std::string>& names) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// Lists what the taken candidates catch. If two wrong lookups have the same name, both must show.
// If every texel has been tried, a wrong lookup that shows at few places cannot show at more and
// does not count as missed.
void add_names(const std::vector<ProbeCandidate>& candidates,
               const std::vector<WrongLookup>& wrongs, const ProbeTaking& choice, bool everywhere,
               ProbeSet& set) {
    std::vector<std::string> unseen;
    for (std::size_t wrong = 0; wrong < wrongs.size(); ++wrong) {
        const auto caught = std::ranges::count_if(candidates, [wrong](const ProbeCandidate& at) {
            return at.taken && at.off[wrong] > kShows;
        });
        if (caught >= kSeveralProbes) {
            add_name(wrongs[wrong].name, set.catches);
        } else {
            add_name(wrongs[wrong].name, choice.shows(wrong) && !everywhere ? set.missed : unseen);
        }
    }
    for (const auto& names : {unseen, set.missed}) {
        for (const std::string& name : names) std::erase(set.catches, name);
    }
}

// Returns the candidates of all spaces, space after space.
std::vector<ProbeCandidate> candidates_of(const std::vector<ProbeSpace>& spaces) {
    std::vector<ProbeCandidate> candidates;
    for (std::size_t space = 0; space < spaces.size(); ++space) {
        for (const std::array<double, 3>& wanted : spaces[space].wanted) {
            candidates.push_back(candidate_at(spaces, space, wanted));
        }
    }
    return candidates;
}

Probe as_probe(TakenProbe taken) {
    Probe probe;
    const std::vector<ProbeLookup>& lookups = taken.place.lookups;
    probe.uvw = lookups.front().uvw;
    if (lookups.size() > 1) probe.blend = BlendedLookup{lookups[1].uvw, lookups[1].share};
    probe.value = std::move(taken.value.value);
    probe.tolerance = std::move(taken.value.tolerance);
    probe.at = std::move(taken.place.at);
    return probe;
}

}  // namespace

ProbeValue probe_value(const ProbedTexture& probed, const std::vector<ProbeLookup>& lookups) {
    const ReadableTexture& texture = probed.texture;
    ProbeValue probe;
    probe.value = look_up(texture, lookups);
    probe.tolerance.assign(texture.channels, 0.0);
    for (const ProbeLookup& lookup : lookups) add_filtering(texture, lookup, probe.tolerance);
    for (std::size_t c = 0; c < texture.channels; ++c) {
        // The scale of a channel that is 0 everywhere is 1.
        const double scale = probed.largest[c] > 0 ? probed.largest[c] : 1;
        probe.tolerance[c] +=
            4 * rounding_error(probed.type) * std::max(1e-3 * scale, std::fabs(probe.value[c]));
    }
    return probe;
}

ProbeSet take_probes(const ProbedTexture& texture, const std::vector<ProbeSpace>& spaces, int count,
                     const BakeOptions& options) {
    const std::vector<WrongLookup> wrongs = wrong_lookups(texture.texture.use, texture.dimensions);
    std::vector<ProbeCandidate> candidates;
    std::set<std::pair<std::array<double, 3>, double>> known;  // first lookups and their shares
    const auto add = [&](std::vector<ProbeCandidate> more) {
        const std::size_t first = candidates.size();
        for (ProbeCandidate& candidate : more) {
            const ProbeLookup& lookup = candidate.place.lookups.front();
            if (!known.emplace(lookup.uvw, lookup.share).second) continue;
            candidates.push_back(std::move(candidate));
        }
        measure_candidates(first, texture, wrongs, options, candidates);
    };
    const TextureUse& use = texture.texture.use;
    add(candidates_of(spaces));
    if (options.cancelled()) return {};  // and not all have been measured
    add(places_about(candidates, wrongs.size(), spaces, use));
    if (options.cancelled()) return {};
    const std::vector<std::size_t> few = shown_at_few(candidates, wrongs.size());
    const bool everywhere = texels_of(use) <= kMostTexels && !few.empty();
    if (everywhere && texels_of(use) <= kFewTexels) {
        std::vector<ProbeCandidate> all;
        for_each_row_of_texels(spaces, use, texture.dimensions,
                               [&](auto row) { std::ranges::move(row, std::back_inserter(all)); });
        add(std::move(all));
    } else if (everywhere) {
        for_each_row_of_texels(spaces, use, texture.dimensions, [&](auto row) {
            const std::size_t first = candidates.size();
            if (options.cancelled()) return;
            add(std::move(row));
            if (!options.cancelled()) keep_what_shows(few, first, candidates);
        });
    }
    if (options.cancelled()) return {};

    const auto spaces_count = static_cast<int>(spaces.size());
    const int share = (count + spaces_count - 1) / spaces_count;
    ProbeTaking choice(candidates, wrongs.size(), share);
    choice.take_what_is_wanted();
    for (std::size_t space = 0; space < spaces.size(); ++space) choice.fill_up(share, space);
    choice.fill_up(count);
    ProbeSet set;
    add_names(candidates, wrongs, choice, everywhere, set);
    for (ProbeCandidate& candidate : candidates) {
        if (!candidate.taken) continue;
        set.probes.push_back({std::move(candidate.place), std::move(candidate.value)});
    }
    return set;
}

std::optional<Diagnostic> weak_probes(const std::string& asset, const ProbeSet& set) {
    if (set.missed.empty()) return std::nullopt;
    return diagnosis(
        "E0407",
        fmt::format("`{}`: its probes would pass a file that is wrong in one of these ways: {}",
                    asset, fmt::join(set.missed, ", ")));
}

ProbedTexture probed_texture(const Level& level, int dimensions, PixelType type) {
    ProbedTexture texture;
    texture.dimensions = dimensions;
    texture.texture.use = {level.size, level.repeats, level.nearest};
    texture.texture.channels = level.statistics.size();
    texture.texture.read = [voxels = StoredVoxels(level, type)](const std::array<VoxelTap, 8>& taps,
                                                                float* values) {
        const std::vector<float> found = voxels.at(taps);
        std::ranges::copy(found, values);
    };
    texture.type = type;
    for (const ValueStatistics& channel : level.statistics) {
        texture.largest.push_back(std::max(std::fabs(channel.min), std::fabs(channel.max)));
    }
    return texture;
}

std::optional<Diagnostic> set_probes(const std::string& asset, const ProbedTexture& texture,
                                     const std::vector<ProbeSpace>& spaces, int count,
                                     const BakeOptions& options, Level& level) {
    ProbeSet set = take_probes(texture, spaces, count, options);
    if (const auto problem = weak_probes(asset, set)) return problem;
    level.probes.clear();
    for (TakenProbe& taken : set.probes) level.probes.push_back(as_probe(std::move(taken)));
    level.catches = std::move(set.catches);
    return std::nullopt;
}

}  // namespace skybake
