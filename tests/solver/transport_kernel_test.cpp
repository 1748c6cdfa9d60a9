// The kernel of one more order of scattering against its formulas, written down sun by sun.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/light/solver/needed_degrees.h"
#include "bakers/light/solver/transport.h"
#include "tests/certificates/random_cases.h"
#include "tests/noise/every_target.h"

namespace skybake {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLevels = 3;
// The error by rounding, as a share of the largest moment.
template <class Number>
constexpr double kRounding = 1e-5;
template <>
constexpr double kRounding<double> = 1e-12;

// The input of a level's transport: light without any order from sun to sun, and rays to it.
struct TransportCase {
    SunAxis suns;
    LightField light;
    std::vector<TransportRay> rays;            // with the index of each node's weights
    std::vector<std::vector<double>> weights;  // by moment_index
    std::vector<double> steep;
    std::vector<double> falls = {};  // SteepSuns'
    std::vector<double> ground_falls = {};

    SteepSuns steep_suns() const {
        SteepSuns suns_that_are(steep);
        suns_that_are.falls = falls;
        suns_that_are.ground_falls = ground_falls;
        return suns_that_are;
    }

    TransportCase(const Shell& shell, int sun_count, int degree, unsigned seed)
        : suns(make_sun_axis(shell, sun_count)),
          light(kLevels, sun_count, degree),
          steep(static_cast<std::size_t>(sun_count), 0.0) {
        test::RandomCase dice(seed);
        for (double& value : light.moments) value = dice.uniform(0.1, 2);
        for (double& value : light.sky_irradiance) value = dice.uniform(0.1, 2);
        for (int i = 0; i < 4; ++i) add_ray(dice);
    }

    template <class Number>
    LevelTransport<Number> transport() const {
        LevelTransport<Number> made;
        made.rays = rays;
        for (TransportRay& ray : made.rays) {
            for (TransportNode& node : ray.nodes) {
                const std::vector<double>& of_node = weights[node.weights];
                const int degree_of_node = node.ground ? 0 : node.degree;
                node.weights = made.weights.size();
                made.weights.resize(node.weights + block_count(degree_of_node));
                write_blocks(degree_of_node, of_node.data(), made.weights.data() + node.weights);
            }
        }
        return made;
    }

  private:
    void add_ray(test::RandomCase& dice) {
        TransportRay ray;
        ray.mu = dice.uniform(-1, 1);
        ray.weight = dice.uniform(0, 0.3);
        for (const bool ground : {false, false, false, true}) {
            TransportNode node;
            node.ground = ground;
            node.level = static_cast<int>(dice.uniform(0, kLevels));
            node.fraction = !ground && node.level + 1 < kLevels ? dice.uniform(0, 1) : 0;
            const double turn = dice.uniform(0, 0.7);
            node.turn_cosine = std::cos(turn);
            node.turn_sine = std::sin(turn);
            const int degrees[] = {light.degree, kDegreeOfHaze, kDegreeOfAir};
            node.degree = std::min(light.degree, degrees[static_cast<int>(dice.uniform(0, 3))]);
            node.azimuths = std::max(4, node.degree + 1) << (dice.uniform(0, 2) < 1 ? 0 : 1);
            node.weights = weights.size();
            weights.emplace_back();
            const int groups = ground ? 1 : moment_count(node.degree);
            for (std::size_t i = 0; i < static_cast<std::size_t>(groups) * kChannelSlots; ++i) {
                weights.back().push_back(dice.uniform(-1, 1));
            }
            ray.nodes.push_back(node);
        }
        rays.push_back(ray);
    }
};

// Lagrange's polynomial through `count` columns from `first` on; where `u` leaves them and there
// are but two, the nearer one.
std::vector<double> weights_of_columns(double u, int first, int count) {
    if (count == 2) u = std::clamp<double>(u, first, first + 1);
    std::vector<double> weights;
    for (int i = 0; i < count; ++i) {
        double weight = 1;
        for (int j = 0; j < count; ++j) {
            if (j != i) weight *= (u - (first + j)) / (i - j);
        }
        weights.push_back(weight);
    }
    return weights;
}

// Light of one azimuthal order at a node, for the sun of a column.
double light_of_column(const TransportCase& any, const TransportNode& node, int column, int m,
                       std::size_t channel) {
    const double* weights = any.weights[node.weights].data() + channel;
    if (node.ground) {
        const auto at = static_cast<std::size_t>(column) * kChannelSlots;
        return m == 0 ? weights[0] * any.light.sky_irradiance[at + channel] : 0;
    }
    double sum = 0;
    for (int l = m; l <= node.degree; ++l) {
        const std::size_t lm = static_cast<std::size_t>(moment_index(l, m)) * kChannelSlots;
        const double low = any.light.at(node.level, column)[lm + channel];
        const double high =
            node.fraction > 0 ? any.light.at(node.level + 1, column)[lm + channel] : 0;
        sum += weights[lm] * ((1 - node.fraction) * low + node.fraction * high);
    }
    return sum;
}

// The power of its sine over which order m of a sun is kept: m, or 7 and 8 by turns.
int power_of_order(int m) { return m <= 8 ? m : m % 2 == 0 ? 8 : 7; }

// sin theta to that power times cos(m phi), from the cosine of theta and sin theta cos phi, which may
// be just beyond sin theta where the sun is taken for the darkest.
double power_of_sine(double cosine, double along, int m) {
    const double squared_sine = (1 - cosine) * (1 + cosine);
    const std::complex<double> root = std::sqrt(std::complex<double>(along * along - squared_sine));
    const double whole = 0.5 * (std::pow(along + root, m) + std::pow(along - root, m)).real();
    return whole / std::pow(squared_sine, (m - power_of_order(m)) / 2);
}

// From a column to the next, at a node between levels.
double fall_at(const TransportCase& any, const TransportNode& node, int column) {
    if (any.falls.empty()) return 0;
    if (node.ground) return any.ground_falls[static_cast<std::size_t>(column)];
    const auto at = [&](int level) {
        return any.falls[static_cast<std::size_t>(level * any.suns.count() + column)];
    };
    if (node.fraction == 0) return at(node.level);
    return (1 - node.fraction) * at(node.level) + node.fraction * at(node.level + 1);
}

// Multiplies linear weights of columns by the ratio of a mean to the mean there, where the mean's
// logarithm is a cubic through four columns.
void follow_falls(const TransportCase& any, const TransportNode& node, double place, int stencil,
                  int first, std::vector<double>& weights) {
    const double fall = fall_at(any, node, first);
    double logarithms[4] = {0, 0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const double here = std::max(fall_at(any, node, stencil + k), 2 * fall);
        logarithms[k + 1] = logarithms[k] - here;
    }
    const std::vector<double> cubic = weights_of_columns(place, 0, 4);
    double mean = 0;
    for (std::size_t k = 0; k < 4; ++k) mean += cubic[k] * logarithms[k];
    for (std::size_t i = 0; i < 2; ++i) {
        weights[i] *= std::exp(mean - logarithms[static_cast<std::size_t>(first - stencil) + i]);
    }
}

// Light that a node sends along its ray, for a sun and a ray that is `azimuth` from it.
double light_of_node(const TransportCase& any, const TransportNode& node, int sun, double azimuth,
                     std::size_t channel) {
    const double cosine = any.suns.cosines[static_cast<std::size_t>(sun)];
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double turned = node.turn_cosine * cosine + node.turn_sine * sine * std::cos(azimuth);
    const double there = std::clamp(turned, any.suns.darkest, 1.0);
    const double along = node.turn_cosine * sine * std::cos(azimuth) - node.turn_sine * cosine;
    const double u = any.suns.position(there);
    const int last = any.suns.count() - 1;
    const int stencil = std::clamp(static_cast<int>(std::floor(u)) - 1, 0, last - 3);
    const bool flat = any.steep[static_cast<std::size_t>(stencil)] > 0;
    const int first = flat ? std::clamp(static_cast<int>(std::floor(u)), 0, last - 1) : stencil;
    std::vector<double> weights = weights_of_columns(u, first, flat ? 2 : 4);
    if (flat) follow_falls(any, node, std::clamp(u - stencil, 0.0, 3.0), stencil, first, weights);
    double sum = 0;
    for (int m = 0; m <= node.degree; ++m) {
        double order = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const int column = first + static_cast<int>(i);
            order += weights[i] * light_of_column(any, node, column, m, channel);
        }
        sum += power_of_sine(there, along, m) * order;
    }
    return sum;
}

struct Applied {
    std::vector<double> moments;
    std::vector<double> sky_irradiance;
};

// The moments of what comes along the rays, not divided by sines; each node has its own degree, which
// ends its moments too, and its own number of azimuths.
Applied expected(const TransportCase& any) {
    Applied sum{std::vector<double>(any.light.level_size()),
                std::vector<double>(any.light.sky_irradiance.size())};
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(any.light.degree)));
    for (const TransportRay& ray : any.rays) {
        zenith_harmonics(any.light.degree, ray.mu, harmonics.data());
        for (const TransportNode& node : ray.nodes) {
            for (int sun = 0; sun < any.suns.count(); ++sun) {
                for (int j = 0; j < node.azimuths; ++j) {
                    const double azimuth = kPi * (j + 0.5) / node.azimuths;
                    const double share = 4 * kPi * ray.weight / node.azimuths;
                    for (std::size_t c = 0; c < kChannelSlots; ++c) {
                        const double value = share * light_of_node(any, node, sun, azimuth, c);
                        for (int l = 0; l <= any.light.degree; ++l) {
                            for (int m = 0; m <= std::min(l, node.degree); ++m) {
                                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                                sum.moments[static_cast<std::size_t>(sun) * any.light.sun_size() +
                                            lm * kChannelSlots + c] +=
                                    value * std::cos(m * azimuth) * harmonics[lm];
                            }
                        }
                        if (ray.mu <= 0) continue;
                        sum.sky_irradiance[static_cast<std::size_t>(sun) * kChannelSlots + c] +=
                            value * ray.mu;
                    }
                }
            }
        }
    }
    return sum;
}

template <class Number>
Applied applied(const TransportCase& any) {
    Applied made{std::vector<double>(any.light.level_size(), -1),
                 std::vector<double>(any.light.sky_irradiance.size(), -1)};
    apply_transport(any.transport<Number>(), any.suns, any.steep_suns(),
                    BlockedLight<Number>(any.light, 1), made.moments.data(),
                    made.sky_irradiance.data());
    return made;
}

// Takes back the division by powers of sines, which would magnify rounding.
std::vector<double> times_sines(const TransportCase& any, std::vector<double> moments) {
    for (int sun = 0; sun < any.suns.count(); ++sun) {
        const double cosine = any.suns.cosines[static_cast<std::size_t>(sun)];
        const double sine = std::sqrt((1 - cosine) * (1 + cosine));
        for (int l = 0; l <= any.light.degree; ++l) {
            for (int m = 0; m <= l; ++m) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m)) * kChannelSlots;
                double* at =
                    moments.data() + static_cast<std::size_t>(sun) * any.light.sun_size() + lm;
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    at[c] *= std::pow(sine, power_of_order(m));
                }
            }
        }
    }
    return moments;
}

void expect_near(const std::vector<double>& made, const std::vector<double>& wanted,
                 double rounding, const char* target) {
    ASSERT_EQ(made.size(), wanted.size());
    double scale = 0;
    for (const double value : wanted) scale = std::max(scale, std::fabs(value));
    int wrong = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (!(std::fabs(made[i] - wanted[i]) <= rounding * scale)) {
            if (++wrong == 1)
                ADD_FAILURE() << target << ": " << i << ": " << made[i] << " for " << wanted[i];
        }
    }
    EXPECT_EQ(wrong, 0) << target;
}

template <class Number>
void expect_right_in(const TransportCase& any, const Applied& wanted) {
    const Applied best = applied<Number>(any);
    test::on_every_target([&](const char* target) {
        const Applied made = applied<Number>(any);
        expect_near(times_sines(any, made.moments), wanted.moments, kRounding<Number>, target);
        expect_near(made.sky_irradiance, wanted.sky_irradiance, kRounding<Number>, target);
        EXPECT_EQ(made.moments, best.moments) << target;
        EXPECT_EQ(made.sky_irradiance, best.sky_irradiance) << target;
    });
}

void expect_right(const TransportCase& any) {
    const Applied wanted = expected(any);
    expect_right_in<float>(any, wanted);
    expect_right_in<double>(any, wanted);
}

const Shell kEarth = {6360, 100};
const Shell kHighAir = {100, 80};

TEST(TransportKernel, InterpolatesByCubics) {
    for (const Shell& shell : {kEarth, kHighAir}) {
        expect_right(TransportCase(shell, 16, 2, 1));
        expect_right(TransportCase(shell, 24, 5, 2));
        expect_right(TransportCase(shell, 16, 13, 6));
    }
}

// To the last column on both sides, where cubics lean on a stencil that does not surround the sun.
TEST(TransportKernel, SteepStencilsAreLinearUpToTheEnds) {
    for (const Shell& shell : {kEarth, kHighAir}) {
        TransportCase any(shell, 16, 4, 3);
        std::fill(any.steep.begin(), any.steep.end(), 1.0);
        expect_right(any);
    }
}

TEST(TransportKernel, SteepStencilsFollowTheFallOfLight) {
    for (const Shell& shell : {kEarth, kHighAir}) {
        TransportCase any(shell, 16, 4, 7);
        std::fill(any.steep.begin(), any.steep.end(), 1.0);
        test::RandomCase dice(8);
        for (int i = 0; i < kLevels * 16; ++i) any.falls.push_back(-dice.uniform(0, 4));
        for (int i = 0; i < 16; ++i) any.ground_falls.push_back(-dice.uniform(0, 4));
        expect_right(any);
    }
}

TEST(TransportKernel, SteepStencilsLeaveTheirNeighboursCubic) {
    TransportCase any(kEarth, 32, 2, 4);
    for (std::size_t i = 0; i < any.steep.size(); i += 3) any.steep[i] = 1;
    expect_right(any);
}

TEST(TransportKernel, TheSkyOverOtherLevelsIsNotAskedFor) {
    const TransportCase any(kEarth, 8, 2, 5);
    std::vector<double> alone(any.light.level_size());
    apply_transport(any.transport<float>(), any.suns, any.steep_suns(),
                    BlockedLight<float>(any.light, 1), alone.data(), nullptr);
    EXPECT_EQ(alone, applied<float>(any).moments);
}

}  // namespace
}  // namespace skybake
