// Whether the largest error and the root mean square of lookups that `--certify=quick` claims are
// those that dense measurements find, on random atmospheres, sizes, mappings, cameras and suns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "tests/certificates/claims.h"

namespace skybake::test {
namespace {

// The ratios of one asset's cases, ascending.
class Ratios {
  public:
    void add(double dense, double claimed) {
        // Errors of the rounding of floats are no errors of lookups.
        constexpr double kRounding = 1e-7;
        all_.push_back(std::max(dense, kRounding) / std::max(claimed, kRounding));
        std::sort(all_.begin(), all_.end());
    }
    double quantile(double share) const {
        return all_[std::min(all_.size() - 1,
                             static_cast<std::size_t>(share * static_cast<double>(all_.size())))];
    }
    int above(double bound) const {
        return static_cast<int>(all_.end() - std::upper_bound(all_.begin(), all_.end(), bound));
    }
    int count() const { return static_cast<int>(all_.size()); }

  private:
    std::vector<double> all_;
};

// The ratios of claims, and those of points that are spread evenly.
struct AssetRatios {
    Ratios max, rms, even_max, even_rms;
};

struct Asset {
    const char* name;
    Claim (*claim)(RandomCase& random);
    int every = 1;  // of a few cases, how many have this asset
};

constexpr Asset kAssets[] = {{"transmittance", claim_of_transmittance},
                             {"multiple_scattering", claim_of_multiple_scattering, 4},
                             {"solved multiple_scattering", claim_of_solved_scattering, 12},
                             {"sky_view", claim_of_sky_view},
                             {"environment", claim_of_environment},
                             {"irradiance", claim_of_irradiance, 6},
                             {"phase", claim_of_phase},
                             {"bruneton single_mie", claim_of_single_mie, 4},
                             {"aerial_perspective", claim_of_aerial_perspective},
                             {"optical_depth", claim_of_optical_depth}};

// The bars: nineteen in twenty claims are at most so much too small.
constexpr double kMostOfMax = 1.5;
constexpr double kMostOfRms = 1.2;

std::string three(const Ratios& ratios) {
    return fmt::format("{:5.2f} {:5.2f} {:5.2f}", ratios.quantile(0.5), ratios.quantile(0.9),
                       ratios.quantile(1));
}

using Table = std::map<std::string, AssetRatios>;

Table ratios_of(int cases, bool all) {
    Table table;
    for (const Asset& asset : kAssets) {
        if (const char* only = std::getenv("SKYBAKE_HONEST_ASSET")) {
            if (std::string(asset.name) != only) continue;
        }
        for (int i = 0; i < cases; i += all ? 1 : asset.every) {
            RandomCase random(static_cast<std::uint64_t>(i) * 7919 + 17);
            const Claim claim = asset.claim(random);
            AssetRatios& ratios = table[asset.name];
            ratios.max.add(claim.dense.max, claim.claimed.max);
            ratios.rms.add(claim.dense.rms, claim.claimed.rms);
            ratios.even_max.add(claim.dense.max, claim.even.max);
            ratios.even_rms.add(claim.dense.rms, claim.even.rms);
            if (std::getenv("SKYBAKE_HONEST_CASES") != nullptr) {
                fmt::print("{} {}: dense {:.3g} {:.3g} claimed {:.3g} {:.3g} even {:.3g} {:.3g}\n",
                           asset.name, i, claim.dense.max, claim.dense.rms, claim.claimed.max,
                           claim.claimed.rms, claim.even.max, claim.even.rms);
            }
        }
    }
    return table;
}

void print(const Table& table) {
    fmt::print(
        "measured densely over claimed: median, one in ten, worst\n{:28}{:>20}{:>20}{:>20}{:>20}\n",
        "", "largest", "RMS", "largest, even", "RMS, even");
    for (const auto& [name, ratios] : table) {
        fmt::print("{:28}{:>20}{:>20}{:>20}{:>20}\n", name, three(ratios.max), three(ratios.rms),
                   three(ratios.even_max), three(ratios.even_rms));
    }
}

int allowed(int cases) { return (cases + 19) / 20; }

TEST(HonestClaims, HoldOnTwelveAtmospheres) {
    const Table table = ratios_of(12, false);
    print(table);
    int cases = 0;
    int max_above = 0;
    int rms_above = 0;
    int even_above = 0;
    for (const auto& [name, ratios] : table) {
        cases += ratios.max.count();
        max_above += ratios.max.above(kMostOfMax);
        rms_above += ratios.rms.above(kMostOfRms);
        even_above += ratios.even_max.above(kMostOfMax);
    }
    EXPECT_LE(max_above, allowed(cases));
    EXPECT_LE(rms_above, allowed(cases));
    // Points that are spread evenly do not pass.
    EXPECT_GT(even_above, 3 * allowed(cases));
}

TEST(SlowHonestClaims, HoldOnTwoHundredAtmospheres) {
    const Table table = ratios_of(200, true);
    print(table);
    for (const auto& [name, ratios] : table) {
        EXPECT_LE(ratios.max.above(kMostOfMax), allowed(ratios.max.count())) << name;
        EXPECT_LE(ratios.rms.above(kMostOfRms), allowed(ratios.rms.count())) << name;
    }
}

}  // namespace
}  // namespace skybake::test
