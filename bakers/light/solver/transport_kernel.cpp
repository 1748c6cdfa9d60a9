#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/light/solver/needed_degrees.h"
#include "bakers/light/solver/order_blocks.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/transcendental.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/solver/transport_kernel.cpp"
#include <hwy/foreach_target.h>

#include "bakers/light/solver/sun_axis-inl.h"
#include "bakers/math/lanes-inl.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// A block of order_blocks.h: four azimuthal orders of four channels, in vectors of any width.
template <class Number>
struct Block {
    using Tag = hn::CappedTag<Number, kBlock>;
    static constexpr std::size_t kPerPart = HWY_MIN(HWY_LANES(Number), kBlock);
    static constexpr std::size_t kParts = kBlock / kPerPart;

    hn::Vec<Tag> parts[kParts];

    static HWY_INLINE Block all(Number x) {
        Block made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) made.parts[i] = hn::Set(Tag(), x);
        return made;
    }
    static HWY_INLINE Block load(const MomentBlock<Number>& block) {
        Block made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) {
            made.parts[i] = hn::Load(Tag(), block.values + i * kPerPart);
        }
        return made;
    }
    HWY_INLINE void store(MomentBlock<Number>& block) const {
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) {
            hn::Store(parts[i], Tag(), block.values + i * kPerPart);
        }
    }

    friend HWY_INLINE Block operator+(Block a, const Block& b) {
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) a.parts[i] = hn::Add(a.parts[i], b.parts[i]);
        return a;
    }
    friend HWY_INLINE Block operator*(Block a, const Block& b) {
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) a.parts[i] = hn::Mul(a.parts[i], b.parts[i]);
        return a;
    }
};

// Makes blocks of four numbers: one for each order, the same for all channels, or one for each
// channel, the same for all orders.
template <class Number>
class Spread {
    using Blocks = Block<Number>;
    using Tag = typename Blocks::Tag;
    using Index = hwy::MakeSigned<Number>;
    static constexpr std::size_t kPerPart = Blocks::kPerPart;
    static constexpr std::size_t kPer128 = 16 / sizeof(Number);
    static constexpr bool kIsWide = kPerPart > kChannelSlots;

  public:
    Spread() {
        if constexpr (kIsWide) {
            Index lanes[kPerPart];
            for (std::size_t i = 0; i < Blocks::kParts; ++i) {
                for (std::size_t k = 0; k < kPerPart; ++k) {
                    lanes[k] = static_cast<Index>((i * kPerPart + k) / kChannelSlots - loaded(i));
                }
                orders_[i] = hn::SetTableIndices(Tag(), lanes);
            }
            for (std::size_t k = 0; k < kPerPart; ++k) {
                lanes[k] = static_cast<Index>(k % kChannelSlots);
            }
            channels_ = hn::SetTableIndices(Tag(), lanes);
        }
    }
    HWY_INLINE Blocks over_channels(const Number* of_orders) const {
        Blocks made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < Blocks::kParts; ++i) {
            if constexpr (kIsWide) {
                made.parts[i] =
                    hn::TableLookupLanes(hn::LoadDup128(Tag(), of_orders + loaded(i)), orders_[i]);
            } else {
                made.parts[i] = hn::Set(Tag(), of_orders[i * kPerPart / kChannelSlots]);
            }
        }
        return made;
    }
    // The channels are those of the block's first order.
    HWY_INLINE Blocks over_orders(const MomentBlock<Number>& of_channels) const {
        Blocks made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < Blocks::kParts; ++i) {
            if constexpr (kIsWide) {
                made.parts[i] =
                    hn::TableLookupLanes(hn::Load(Tag(), of_channels.values), channels_);
            } else {
                made.parts[i] = hn::Load(Tag(), of_channels.values + i * kPerPart % kChannelSlots);
            }
        }
        return made;
    }

  private:
    // The first order of those that are loaded for a part.
    static constexpr std::size_t loaded(std::size_t part) {
        return part * kPerPart / kChannelSlots / kPer128 * kPer128;
    }

    using Indices = decltype(hn::SetTableIndices(Tag(), static_cast<Index*>(nullptr)));
    Indices orders_[Blocks::kParts];
    Indices channels_;
};

HWY_INLINE Lanes power_of_e(Lanes x) { return exponential(x); }
HWY_INLINE FloatLanes power_of_e(FloatLanes x) {
    const FloatLanes falling = exponential_of_negative(-absolute(x));
    return select(x > FloatLanes(0.0F), FloatLanes(1.0F) / falling, falling);
}

// Suns are taken in whole vectors of any width up to this; behind the last sun there is room.
constexpr std::size_t kMostLanes = 16;

// Sets of azimuths: few and many, for nodes of the light's degree, of haze and of air alone.
constexpr std::size_t kSets = 6;

// The state of a level's transport. Number is float or double.
template <class Number>
class LevelPass {
    using Blocks = Block<Number>;
    using Moments = MomentBlock<Number>;
    using Reals = LanesOf<Number>;
    using Index = hwy::MakeSigned<Number>;

  public:
    LevelPass(const SunAxis& suns, const SteepSuns& steep, const BlockedLight<Number>& light);

    void apply(const LevelTransport<Number>& transport, double* out, double* sky_irradiance);

  private:
    // Returns the numbers of azimuths that make_level_transport chooses among.
    std::size_t azimuths_of(std::size_t set) const {
        return std::max<std::size_t>(4, orders_of(set)) << set % 2;
    }
    std::size_t orders_of(std::size_t set) const {
        const std::size_t most[] = {orders_, kDegreeOfHaze + 1, kDegreeOfAir + 1};
        return std::min(orders_, most[set / 2]);
    }
    std::size_t quads_of(std::size_t set) const {
        return quad_count(static_cast<int>(orders_of(set)) - 1);
    }
    std::size_t set_of(const TransportNode& node) const {
        std::size_t few = 0;
        while (few + 2 < kSets && static_cast<std::size_t>(node.degree) < orders_of(few + 2))
            few += 2;
        return static_cast<std::size_t>(node.azimuths) == azimuths_of(few) ? few : few + 1;
    }
    void gather_rows(const TransportNode& node, const Moments* weights);
    void gather_ground(const Moments& weight);
    void gather_falls(const TransportNode& node);
    void place_suns(const TransportNode& node, std::size_t quads, Number azimuth_cosine);
    void place_steep(Reals first, Reals place, typename Reals::Mask is_steep, Reals* weight) const;
    void store_powers(Reals along, Reals squared_sine, std::size_t quads, std::size_t i);
    template <bool kIsFirst>
    void add_rows(std::size_t quads, Moments* sum) const;
    void add_node(const LevelTransport<Number>& transport, const TransportNode& node);
    void add_ray(const TransportRay& ray, double* sky_irradiance);
    void write(double* out) const;

    const SunAxis& axis_;
    const BlockedLight<Number>& light_;
    Spread<Number> spread_;
    std::size_t suns_;
    std::size_t room_;    // for whole vectors of suns
    std::size_t orders_;  // m = 0 .. degree
    std::size_t quads_;
    std::vector<Number> cosines_;
    std::vector<Number> sines_;
    std::vector<Number> widths_from_centre_;  // (mu_s - centre) / width
    std::vector<Number> steep_;
    const SteepSuns& of_steep_;
    std::vector<Number> falls_;          // of the columns at a node (SteepSuns)
    std::vector<Moments> rows_;          // [sun * quads + q]: what is sent along
    std::vector<Index> columns_;         // of the suns as seen from a node
    std::vector<Number> cubic_;          // [k * room + sun]
    std::vector<Number> powers_;         // [(q * room + sun) * kQuad + ...]: of store_powers
    std::vector<Moments> along_[kSets];  // [azimuth * suns + sun]
    bool used_[kSets] = {};
    std::vector<Number> azimuth_cosines_[kSets];
    std::vector<Number>
        fourier_[kSets];         // [(azimuth * quads + q) * kQuad + ...]: cos(m phi) / azimuths
    std::vector<Moments> sums_;  // [sun * blocks + block]: the moments
};

template <class Number>
LevelPass<Number>::LevelPass(const SunAxis& suns, const SteepSuns& steep,
                             const BlockedLight<Number>& light)
    : axis_(suns),
      light_(light),
      suns_(static_cast<std::size_t>(suns.count())),
      room_((suns_ + kMostLanes - 1) / kMostLanes * kMostLanes),
      orders_(static_cast<std::size_t>(light.degree) + 1),
      quads_(quad_count(light.degree)),
      cosines_(room_),
      sines_(room_),
      widths_from_centre_(room_),
      steep_(steep.stencils.begin(), steep.stencils.end()),
      of_steep_(steep),
      falls_(suns_),
      rows_(suns_ * quads_),
      columns_(room_),
      cubic_(4 * room_),
      powers_(quads_ * room_ * kQuad),
      sums_(light.level_size()) {
    for (std::size_t i = 0; i < room_; ++i) {
        const double cosine = suns.cosines[std::min(i, suns_ - 1)];
        cosines_[i] = static_cast<Number>(cosine);
        sines_[i] = static_cast<Number>(square_root((1 - cosine) * (1 + cosine)));
        widths_from_centre_[i] = static_cast<Number>((cosine - suns.centre) / suns.width);
    }
    for (std::size_t set = 0; set < kSets; ++set) {
        const std::size_t azimuths = azimuths_of(set);
        along_[set].resize(azimuths * suns_);
        fourier_[set].resize(azimuths * quads_ * kQuad);
        for (std::size_t j = 0; j < azimuths; ++j) {
            const double half_turn = (static_cast<double>(j) + 0.5) / static_cast<double>(azimuths);
            azimuth_cosines_[set].push_back(static_cast<Number>(cosine_of_pi(half_turn)));
            for (std::size_t m = 0; m < orders_of(set); ++m) {
                fourier_[set][j * quads_ * kQuad + m] =
                    static_cast<Number>(cosine_of_turns(0.5 * half_turn * static_cast<double>(m)) /
                                        static_cast<double>(azimuths));
            }
        }
    }
}

template <class Number>
void LevelPass<Number>::gather_ground(const Moments& weight) {
    for (std::size_t i = 0; i < suns_; ++i) {
        (Blocks::load(weight) * Blocks::load(light_.sky_irradiance[i])).store(rows_[i * quads_]);
    }
}

// The light that a node sends along the ray, for the suns of the grid at the node.
template <class Number>
void LevelPass<Number>::gather_rows(const TransportNode& node, const Moments* weights) {
    const Blocks near = Blocks::all(static_cast<Number>(1 - node.fraction));
    const Blocks far = Blocks::all(static_cast<Number>(node.fraction));
    const bool between = node.fraction > 0;
    const auto orders = static_cast<std::size_t>(node.degree) + 1;
    const std::size_t left_out = orders_ - orders;
    for (std::size_t i = 0; i < suns_; ++i) {
        const Moments* weight = weights;
        const Moments* low = light_.at(node.level) + i * light_.sun_size();
        const Moments* high = low + (between ? light_.level_size() : 0);
        Moments* row = rows_.data() + i * quads_;
        for (std::size_t least = 0; least < orders; least += kQuad) {
            Blocks sum = Blocks::all(0);
            Blocks sum_above = Blocks::all(0);
            for (std::size_t l = least; l < orders; ++l) {
                const Blocks factor = Blocks::load(*weight++);
                sum = sum + factor * Blocks::load(*low++);
                if (between) sum_above = sum_above + factor * Blocks::load(*high++);
            }
            if (between) sum = near * sum + far * sum_above;
            sum.store(*row++);
            low += left_out;
            high += left_out;
        }
    }
}

template <class Number>
void LevelPass<Number>::gather_falls(const TransportNode& node) {
    if (of_steep_.falls.empty()) return;
    const double* low = node.ground
                            ? of_steep_.ground_falls.data()
                            : of_steep_.falls.data() + static_cast<std::size_t>(node.level) * suns_;
    const double* high = low + (node.fraction > 0 ? suns_ : 0);
    for (std::size_t i = 0; i < suns_; ++i) {
        falls_[i] = static_cast<Number>((1 - node.fraction) * low[i] + node.fraction * high[i]);
    }
}

// Stores sine^sine_power(m) cos(m phi') for suns at the node.
template <class Number>
HWY_INLINE void LevelPass<Number>::store_powers(Reals along, Reals squared_sine, std::size_t quads,
                                                std::size_t i) {
    const AzimuthRecursion<Reals> powers(along, squared_sine, orders_);
    const Reals twice = along + along;
    Reals power[kQuad] = {Reals(1.0), along, twice * along - squared_sine, along};
    power[3] = twice * power[2] - squared_sine * power[1];
    for (std::size_t q = 0;; ++q) {
        hn::StoreInterleaved4(power[0].v, power[1].v, power[2].v, power[3].v, typename Reals::Tag(),
                              powers_.data() + (q * room_ + i) * kQuad);
        if (q + 1 == quads) return;
        HWY_UNROLL(4)
        for (std::size_t k = 0; k < kQuad; ++k) {
            power[k] = powers.next((q + 1) * kQuad + k, power[(k + 3) % kQuad],
                                   power[(k + 2) % kQuad], power[k]);
        }
    }
}

// steep_weights for the suns `is_steep` at a place in columns from their first column.
template <class Number>
HWY_NOINLINE void LevelPass<Number>::place_steep(Reals first, Reals place,
                                                 typename Reals::Mask is_steep,
                                                 Reals* weight) const {
    const Reals inside = minimum(maximum(place, Reals(0.0)), Reals(3.0));
    const Reals low = minimum(floor_of(inside), Reals(2.0));
    const Reals share = inside - low;
    const Reals t = inside - Reals(1.0);
    const Reals before = t - Reals(1.0);
    const Reals far = Reals(2.0) - t;
    const Reals cubic[3] = {t * before * far * Reals(static_cast<Number>(1.0 / 6)),
                            Reals(-0.5) * inside * far * before, Reals(0.5) * inside * far * t};
    const typename Reals::Mask in_first = low < Reals(0.5);
    const typename Reals::Mask in_last = low > Reals(1.5);
    Reals falls[3];
    for (std::size_t k = 0; k < 3; ++k) falls[k] = gather(falls_.data() + k, to_int(first));
    const Reals fall = select(in_first, falls[0], select(in_last, falls[2], falls[1]));
    Reals bend(0.0);
    Reals sum(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const Reals column(static_cast<Number>(k));
        const Reals linear = maximum(Reals(1.0) - absolute(inside - column), Reals(0.0));
        sum = sum + (cubic[k] - linear);
        bend = bend + sum * maximum(falls[k], fall + fall);
    }
    const Reals darker = (Reals(1.0) - share) * power_of_e(bend - share * fall);
    const Reals brighter = share * power_of_e(bend + (Reals(1.0) - share) * fall);
    const Reals none(0.0);
    const Reals steep[4] = {
        select(in_first, darker, none), select(in_first, brighter, select(in_last, none, darker)),
        select(in_last, darker, select(in_first, none, brighter)), select(in_last, brighter, none)};
    for (std::size_t k = 0; k < 4; ++k) weight[k] = select(is_steep, steep[k], weight[k]);
}

// Where the suns stand as seen from the node, for one azimuth. Where they are between the columns
// follows from how far they move in the axis's widths, which floats tell as well around planets
// with thin shells.
template <class Number>
void LevelPass<Number>::place_suns(const TransportNode& node, std::size_t quads,
                                   Number azimuth_cosine) {
    const double sine = node.turn_sine;
    const double less_than_one =
        node.turn_cosine > 0 ? sine * sine / (1 + node.turn_cosine) : 1 - node.turn_cosine;
    const Reals turn_cosine(static_cast<Number>(node.turn_cosine));
    const Reals turn_sine(static_cast<Number>(sine));
    const Reals across(static_cast<Number>(sine / axis_.width));
    const Reals down(static_cast<Number>(less_than_one / axis_.width));
    const Reals least(static_cast<Number>((axis_.darkest - axis_.centre) / axis_.width));
    const Reals most(static_cast<Number>((1 - axis_.centre) / axis_.width));
    const Reals offset(static_cast<Number>(axis_.offset + axis_.even * axis_.centre));
    const Reals even(static_cast<Number>(axis_.even * axis_.width));
    const Reals dense(static_cast<Number>(axis_.dense));
    const Reals centre(static_cast<Number>(axis_.centre));
    const Reals width(static_cast<Number>(axis_.width));
    const Reals last_column(static_cast<Number>(suns_ - 4));
    for (std::size_t i = 0; i < room_; i += Reals::kCount) {
        const Reals cosine = Reals::load(cosines_.data() + i);
        const Reals along = Reals::load(sines_.data() + i) * Reals(azimuth_cosine);
        const Reals moved =
            Reals::load(widths_from_centre_.data() + i) + (across * along - down * cosine);
        const Reals x = maximum(minimum(moved, most), least);
        const Reals u = offset + even * x + dense * (x / square_root(Reals(1.0) + x * x));
        const Reals column = minimum(maximum(floor_of(u) - Reals(1.0), Reals(0.0)), last_column);
        const LanesOf<Index> index = to_int(column);
        index.store(columns_.data() + i);
        const Reals from_first = u - column;
        const Reals t = from_first - Reals(1.0);
        const Reals before = t - Reals(1.0);
        const Reals far = Reals(2.0) - t;
        const Reals inner = from_first * far;
        const Reals outer = t * before;
        Reals weight[4] = {outer * far * Reals(static_cast<Number>(1.0 / 6)),
                           Reals(-0.5) * inner * before, inner * t * Reals(0.5),
                           outer * from_first * Reals(static_cast<Number>(1.0 / 6))};
        const typename Reals::Mask is_steep = gather(steep_.data(), index) > Reals(0.0);
        if (any(is_steep)) {
            place_steep(column, from_first, is_steep, weight);
        }
        for (std::size_t k = 0; k < 4; ++k) weight[k].store(cubic_.data() + k * room_ + i);
        const Reals there = centre + width * x;
        store_powers(turn_cosine * along - turn_sine * cosine,
                     (Reals(1.0) - there) * (Reals(1.0) + there), quads, i);
    }
}

// Adds to sum[sun] the rows at the suns' places.
template <class Number>
template <bool kIsFirst>
void LevelPass<Number>::add_rows(std::size_t quads, Moments* sum) const {
    for (std::size_t i = 0; i < suns_; ++i) {
        const Moments* row = rows_.data() + static_cast<std::size_t>(columns_[i]) * quads_;
        const Blocks w0 = Blocks::all(cubic_[i]);
        const Blocks w1 = Blocks::all(cubic_[room_ + i]);
        const Blocks w2 = Blocks::all(cubic_[2 * room_ + i]);
        const Blocks w3 = Blocks::all(cubic_[3 * room_ + i]);
        Blocks total = kIsFirst ? Blocks::all(0) : Blocks::load(sum[i]);
        for (std::size_t q = 0; q < quads; ++q) {
            const Moments* at = row + q;
            const Blocks value =
                (w0 * Blocks::load(at[0]) + w1 * Blocks::load(at[quads_])) +
                (w2 * Blocks::load(at[2 * quads_]) + w3 * Blocks::load(at[3 * quads_]));
            total = total + spread_.over_channels(powers_.data() + (q * room_ + i) * kQuad) * value;
        }
        total.store(sum[i]);
    }
}

template <class Number>
void LevelPass<Number>::add_node(const LevelTransport<Number>& transport,
                                 const TransportNode& node) {
    const Moments* weights = transport.weights.data() + node.weights;
    if (node.ground) {
        gather_ground(*weights);
    } else {
        gather_rows(node, weights);
    }
    gather_falls(node);
    const std::size_t set = set_of(node);
    const std::size_t quads = node.ground ? 1 : quads_of(set);
    for (std::size_t j = 0; j < azimuths_of(set); ++j) {
        place_suns(node, quads, azimuth_cosines_[set][j]);
        Moments* sum = along_[set].data() + j * suns_;
        used_[set] ? add_rows<false>(quads, sum) : add_rows<true>(quads, sum);
    }
    used_[set] = true;
}

// Adds the moments of the light along a ray.
template <class Number>
void LevelPass<Number>::add_ray(const TransportRay& ray, double* sky_irradiance) {
    const std::size_t blocks = block_count(light_.degree);
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(light_.degree)));
    zenith_harmonics(light_.degree, ray.mu, harmonics.data());
    const double solid_angle = 4 * std::numbers::pi * ray.weight;
    std::vector<Number> factors(blocks * kQuad);
    for_each_block(light_.degree, [&](std::size_t block, int l, int least) {
        for (int m = least; m <= l && m < least + static_cast<int>(kQuad); ++m) {
            factors[block * kQuad + static_cast<std::size_t>(m - least)] = static_cast<Number>(
                solid_angle * harmonics[static_cast<std::size_t>(moment_index(l, m))]);
        }
    });
    for (std::size_t i = 0; i < suns_; ++i) {
        // The sums over orders, by azimuth.
        for (std::size_t set = 0; set < kSets; ++set) {
            for (std::size_t j = 0; used_[set] && j < azimuths_of(set); ++j) {
                Number* at = along_[set][j * suns_ + i].values;
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    at[c] = (at[c] + at[c + 4]) + (at[c + 8] + at[c + 12]);
                }
            }
        }
        std::size_t block = 0;
        for (std::size_t q = 0; q < quads_; ++q) {
            Blocks mean = Blocks::all(0);
            for (std::size_t set = 0; set < kSets; ++set) {
                if (q >= quads_of(set)) continue;
                for (std::size_t j = 0; used_[set] && j < azimuths_of(set); ++j) {
                    const Number* weight = fourier_[set].data() + (j * quads_ + q) * kQuad;
                    mean = mean + spread_.over_channels(weight) *
                                      spread_.over_orders(along_[set][j * suns_ + i]);
                }
            }
            if (q == 0 && sky_irradiance && ray.mu > 0) {
                Moments first;
                mean.store(first);
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    sky_irradiance[i * kChannelSlots + c] += solid_angle * ray.mu * first.values[c];
                }
            }
            for (std::size_t l = q * kQuad; l < orders_; ++l, ++block) {
                Moments& to = sums_[i * blocks + block];
                (Blocks::load(to) + spread_.over_channels(factors.data() + block * kQuad) * mean)
                    .store(to);
            }
        }
    }
}

// Moments are kept over powers of the sun's sine.
template <class Number>
void LevelPass<Number>::write(double* out) const {
    for (std::size_t i = 0; i < suns_; ++i) {
        const double cosine = axis_.cosines[i];
        const SinePowers factors = powers_of(1 / square_root((1 - cosine) * (1 + cosine)));
        const Moments* from = sums_.data() + i * light_.sun_size();
        double* to =
            out + i * static_cast<std::size_t>(moment_count(light_.degree)) * kChannelSlots;
        for_each_block(light_.degree, [&](std::size_t block, int l, int least) {
            for (int m = least; m <= l && m < least + static_cast<int>(kQuad); ++m) {
                const auto k = static_cast<std::size_t>(m - least);
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    to[static_cast<std::size_t>(moment_index(l, m)) * kChannelSlots + c] =
                        factors[static_cast<std::size_t>(sine_power(m))] *
                        from[block].values[k * kChannelSlots + c];
                }
            }
        });
    }
}

template <class Number>
void LevelPass<Number>::apply(const LevelTransport<Number>& transport, double* out,
                              double* sky_irradiance) {
    if (sky_irradiance) std::fill(sky_irradiance, sky_irradiance + suns_ * kChannelSlots, 0.0);
    for (const TransportRay& ray : transport.rays) {
        for (bool& used : used_) used = false;
        for (const TransportNode& node : ray.nodes) add_node(transport, node);
        add_ray(ray, sky_irradiance);
    }
    write(out);
}

void ApplyInFloat(const LevelTransport<float>& transport, const SunAxis& suns,
                  const SteepSuns& steep, const BlockedLight<float>& light, double* out,
                  double* sky_irradiance) {
    LevelPass<float>(suns, steep, light).apply(transport, out, sky_irradiance);
}

void ApplyInDouble(const LevelTransport<double>& transport, const SunAxis& suns,
                   const SteepSuns& steep, const BlockedLight<double>& light, double* out,
                   double* sky_irradiance) {
    LevelPass<double>(suns, steep, light).apply(transport, out, sky_irradiance);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(ApplyInFloat);
HWY_EXPORT(ApplyInDouble);

void apply_transport(const LevelTransport<float>& transport, const SunAxis& suns,
                     const SteepSuns& steep, const BlockedLight<float>& light, double* out,
                     double* sky_irradiance) {
    assert(light.suns == suns.count() && steep.stencils.size() >= suns.cosines.size() - 3);
    HWY_DYNAMIC_DISPATCH(ApplyInFloat)(transport, suns, steep, light, out, sky_irradiance);
}

void apply_transport(const LevelTransport<double>& transport, const SunAxis& suns,
                     const SteepSuns& steep, const BlockedLight<double>& light, double* out,
                     double* sky_irradiance) {
    assert(light.suns == suns.count() && steep.stencils.size() >= suns.cosines.size() - 3);
    HWY_DYNAMIC_DISPATCH(ApplyInDouble)(transport, suns, steep, light, out, sky_irradiance);
}

}  // namespace skybake
#endif  // HWY_ONCE
