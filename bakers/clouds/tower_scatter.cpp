// scattered_towers of tower_field.h.
#include <cstdint>
#include <numbers>

#include "bakers/clouds/tower_field.h"
#include "bakers/math/transcendental.h"
#include "bakers/noise/lattice_hash.h"

namespace skybake::cloud {

namespace {

using config::Tower;
using config::TowerScatter;
using noise::kGolden64;
using noise::mix64;

// Numbers in [0, 1) of 53 bits, one after the other.
class UnitNumbers {
  public:
    UnitNumbers(std::uint64_t seed, std::uint64_t tower)
        : state_(mix64(mix64(seed + kGolden64) ^ (tower * kGolden64))) {}
    double next() {
        state_ += kGolden64;
        return static_cast<double>(mix64(state_) >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

double between(const std::array<double, 2>& range, double t) {
    return range[0] * (1 - t) + range[1] * t;
}

Tower scattered_tower(const TowerScatter& scatter, int index) {
    UnitNumbers numbers(scatter.seed, static_cast<std::uint64_t>(index));
    Tower tower;
    tower.center = {numbers.next(), numbers.next()};
    const std::array<double, 2> logarithms = {logarithm(scatter.sigma[0]),
                                              logarithm(scatter.sigma[1])};
    const double sigma = exponential(between(logarithms, numbers.next()));
    tower.sigma = {sigma, sigma * between(scatter.aspect, numbers.next())};
    tower.rotation = {std::numbers::pi * numbers.next()};
    tower.amplitude = between(scatter.amplitude, numbers.next());
    return tower;
}

}  // namespace

std::vector<Tower> scattered_towers(const TowerScatter& scatter) {
    std::vector<Tower> towers;
    for (int i = 0; i < scatter.count; ++i) towers.push_back(scattered_tower(scatter, i));
    return towers;
}

}  // namespace skybake::cloud
