#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "bakers/light/solver/order_blocks.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/transcendental.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/solver/transport_kernel.cpp"
#include <hwy/foreach_target.h>

#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// A block of order_blocks.h: four azimuthal orders of four channels, in vectors of any width.
struct Block {
    using Tag = hn::CappedTag<float, kBlock>;
    static constexpr std::size_t kPerPart = HWY_MIN(HWY_LANES(float), kBlock);
    static constexpr std::size_t kParts = kBlock / kPerPart;

    hn::Vec<Tag> parts[kParts];

    static HWY_INLINE Block all(float x) {
        Block made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) made.parts[i] = hn::Set(Tag(), x);
        return made;
    }
    static HWY_INLINE Block load(const MomentBlock& block) {
        Block made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) {
            made.parts[i] = hn::Load(Tag(), block.values + i * kPerPart);
        }
        return made;
    }
    HWY_INLINE void store(MomentBlock& block) const {
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < kParts; ++i) {
            hn::Store(parts[i], Tag(), block.values + i * kPerPart);
        }
    }
};

HWY_INLINE Block operator+(Block a, const Block& b) {
    HWY_UNROLL(16)
    for (std::size_t i = 0; i < Block::kParts; ++i) a.parts[i] = hn::Add(a.parts[i], b.parts[i]);
    return a;
}
HWY_INLINE Block operator*(Block a, const Block& b) {
    HWY_UNROLL(16)
    for (std::size_t i = 0; i < Block::kParts; ++i) a.parts[i] = hn::Mul(a.parts[i], b.parts[i]);
    return a;
}

// Makes blocks of four numbers: one for each order, the same for all channels, or one for each
// channel, the same for all orders.
class Spread {
  public:
    Spread() {
        if constexpr (Block::kPerPart > kChannelSlots) {
            for (std::size_t i = 0; i < Block::kParts; ++i) {
                std::int32_t lanes[Block::kPerPart];
                for (std::size_t k = 0; k < Block::kPerPart; ++k) {
                    lanes[k] = static_cast<std::int32_t>((i * Block::kPerPart + k) / kChannelSlots);
                }
                orders_[i] = hn::SetTableIndices(Block::Tag(), lanes);
            }
        }
    }
    HWY_INLINE Block over_channels(const float* of_orders) const {
        Block made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < Block::kParts; ++i) {
            if constexpr (Block::kPerPart > kChannelSlots) {
                made.parts[i] =
                    hn::TableLookupLanes(hn::LoadDup128(Block::Tag(), of_orders), orders_[i]);
            } else {
                made.parts[i] =
                    hn::Set(Block::Tag(), of_orders[i * Block::kPerPart / kChannelSlots]);
            }
        }
        return made;
    }
    HWY_INLINE Block over_orders(const float* of_channels) const {
        Block made;
        HWY_UNROLL(16)
        for (std::size_t i = 0; i < Block::kParts; ++i) {
            if constexpr (Block::kPerPart >= kChannelSlots) {
                made.parts[i] = hn::LoadDup128(Block::Tag(), of_channels);
            } else {
                made.parts[i] =
                    hn::LoadU(Block::Tag(), of_channels + i * Block::kPerPart % kChannelSlots);
            }
        }
        return made;
    }

  private:
    using Indices =
        decltype(hn::SetTableIndices(Block::Tag(), static_cast<std::int32_t*>(nullptr)));
    Indices orders_[Block::kParts];
};

// Suns are taken in whole vectors of any width up to this; behind the last sun there is room.
constexpr std::size_t kMostLanes = 16;

// What a level's transport works with.
class LevelPass {
  public:
    LevelPass(const SunAxis& suns, const std::vector<double>& steep, const BlockedLight& light);

    void apply(const LevelTransport& transport, double* out, double* sky_irradiance);

  private:
    // Those that make_level_transport chooses among.
    std::size_t azimuths_of(std::size_t set) const {
        return std::max<std::size_t>(4, orders_) << set;
    }
    void gather_rows(const TransportNode& node, const MomentBlock* weights);
    void gather_ground(const MomentBlock& weight);
    void place_suns(const TransportNode& node, float azimuth_cosine);
    void store_powers(FloatLanes first, FloatLanes squared_sine, std::size_t i);
    template <bool kIsFirst>
    void add_rows(std::size_t quads, MomentBlock* sum) const;
    void add_node(const LevelTransport& transport, const TransportNode& node);
    void add_ray(const TransportRay& ray, double* sky_irradiance);
    void write(double* out) const;

    const SunAxis& axis_;
    const BlockedLight& light_;
    Spread spread_;
    std::size_t suns_;
    std::size_t room_;    // for whole vectors of suns
    std::size_t orders_;  // m = 0 .. degree
    std::size_t quads_;
    std::vector<float> cosines_;
    std::vector<float> sines_;
    std::vector<float> widths_from_centre_;  // (mu_s - centre) / width
    std::vector<float> steep_;
    std::vector<MomentBlock> rows_;      // [sun * quads + q]: what is sent along
    std::vector<std::int32_t> columns_;  // of the suns as seen from a node
    std::vector<float> cubic_;           // [k * room + sun]
    std::vector<float> powers_;  // [(q * room + sun) * kQuad + ...]: sin^m theta_s' cos(m phi')
    std::vector<MomentBlock> along_[2];  // [azimuth * suns + sun]: by few and by many azimuths
    bool used_[2] = {};
    std::vector<float> azimuth_cosines_[2];
    std::vector<float> fourier_[2];  // [(azimuth * quads + q) * kQuad + ...]: cos(m phi) / azimuths
    std::vector<MomentBlock> sums_;  // [sun * blocks + block]: the moments
};

LevelPass::LevelPass(const SunAxis& suns, const std::vector<double>& steep,
                     const BlockedLight& light)
    : axis_(suns),
      light_(light),
      suns_(static_cast<std::size_t>(suns.count())),
      room_((suns_ + kMostLanes - 1) / kMostLanes * kMostLanes),
      orders_(static_cast<std::size_t>(light.degree) + 1),
      quads_(quad_count(light.degree)),
      cosines_(room_),
      sines_(room_),
      widths_from_centre_(room_),
      steep_(steep.begin(), steep.end()),
      rows_(suns_ * quads_),
      columns_(room_),
      cubic_(4 * room_),
      powers_(quads_ * room_ * kQuad),
      sums_(light.level_size()) {
    for (std::size_t i = 0; i < room_; ++i) {
        const double cosine = suns.cosines[std::min(i, suns_ - 1)];
        cosines_[i] = static_cast<float>(cosine);
        sines_[i] = static_cast<float>(square_root((1 - cosine) * (1 + cosine)));
        widths_from_centre_[i] = static_cast<float>((cosine - suns.centre) / suns.width);
    }
    for (std::size_t set = 0; set < 2; ++set) {
        const std::size_t azimuths = azimuths_of(set);
        along_[set].resize(azimuths * suns_);
        fourier_[set].resize(azimuths * quads_ * kQuad);
        for (std::size_t j = 0; j < azimuths; ++j) {
            const double half_turn = (static_cast<double>(j) + 0.5) / static_cast<double>(azimuths);
            azimuth_cosines_[set].push_back(static_cast<float>(cosine_of_pi(half_turn)));
            for (std::size_t m = 0; m < orders_; ++m) {
                fourier_[set][j * quads_ * kQuad + m] =
                    static_cast<float>(cosine_of_turns(0.5 * half_turn * static_cast<double>(m)) /
                                       static_cast<double>(azimuths));
            }
        }
    }
}

void LevelPass::gather_ground(const MomentBlock& weight) {
    for (std::size_t i = 0; i < suns_; ++i) {
        (Block::load(weight) * Block::load(light_.sky_irradiance[i])).store(rows_[i * quads_]);
    }
}

// The light that a node sends along the ray, for the suns of the grid at the node.
void LevelPass::gather_rows(const TransportNode& node, const MomentBlock* weights) {
    const Block near = Block::all(static_cast<float>(1 - node.fraction));
    const Block far = Block::all(static_cast<float>(node.fraction));
    const bool between = node.fraction > 0;
    const MomentBlock* low = light_.at(node.level);
    const MomentBlock* high = low + (between ? light_.level_size() : 0);
    MomentBlock* row = rows_.data();
    for (std::size_t i = 0; i < suns_; ++i) {
        const MomentBlock* weight = weights;
        for (std::size_t q = 0; q < quads_; ++q) {
            Block sum = Block::all(0);
            Block sum_above = Block::all(0);
            for (std::size_t l = q * kQuad; l < orders_; ++l) {
                const Block factor = Block::load(*weight++);
                sum = sum + factor * Block::load(*low++);
                if (between) sum_above = sum_above + factor * Block::load(*high++);
            }
            if (between) sum = near * sum + far * sum_above;
            sum.store(*row++);
        }
    }
}

// sin^m theta_s' cos(m phi') by Chebyshev's recursion.
HWY_INLINE void LevelPass::store_powers(FloatLanes first, FloatLanes squared_sine, std::size_t i) {
    const FloatLanes twice = first + first;
    FloatLanes power[kQuad] = {FloatLanes(1.0F), first, twice * first - squared_sine, first};
    power[3] = twice * power[2] - squared_sine * power[1];
    for (std::size_t q = 0;; ++q) {
        hn::StoreInterleaved4(power[0].v, power[1].v, power[2].v, power[3].v, FloatLanes::Tag(),
                              powers_.data() + (q * room_ + i) * kQuad);
        if (q + 1 == quads_) return;
        power[0] = twice * power[3] - squared_sine * power[2];
        power[1] = twice * power[0] - squared_sine * power[3];
        power[2] = twice * power[1] - squared_sine * power[0];
        power[3] = twice * power[2] - squared_sine * power[1];
    }
}

// Where the suns stand as seen from the node, for one azimuth. Where they are between the columns
// follows from how far they move in the axis's widths, which floats tell as well around planets
// with thin shells.
void LevelPass::place_suns(const TransportNode& node, float azimuth_cosine) {
    const double sine = node.turn_sine;
    const double less_than_one =
        node.turn_cosine > 0 ? sine * sine / (1 + node.turn_cosine) : 1 - node.turn_cosine;
    const FloatLanes turn_cosine(static_cast<float>(node.turn_cosine));
    const FloatLanes turn_sine(static_cast<float>(sine));
    const FloatLanes across(static_cast<float>(sine / axis_.width));
    const FloatLanes down(static_cast<float>(less_than_one / axis_.width));
    const FloatLanes least(static_cast<float>((axis_.darkest - axis_.centre) / axis_.width));
    const FloatLanes most(static_cast<float>((1 - axis_.centre) / axis_.width));
    const FloatLanes offset(static_cast<float>(axis_.offset + axis_.even * axis_.centre));
    const FloatLanes even(static_cast<float>(axis_.even * axis_.width));
    const FloatLanes dense(static_cast<float>(axis_.dense));
    const FloatLanes centre(static_cast<float>(axis_.centre));
    const FloatLanes width(static_cast<float>(axis_.width));
    const FloatLanes last_column(static_cast<float>(suns_ - 4));
    for (std::size_t i = 0; i < room_; i += FloatLanes::kCount) {
        const FloatLanes cosine = FloatLanes::load(cosines_.data() + i);
        const FloatLanes along = FloatLanes::load(sines_.data() + i) * FloatLanes(azimuth_cosine);
        const FloatLanes moved =
            FloatLanes::load(widths_from_centre_.data() + i) + (across * along - down * cosine);
        const FloatLanes x = maximum(minimum(moved, most), least);
        const FloatLanes u =
            offset + even * x + dense * (x / square_root(FloatLanes(1.0F) + x * x));
        const FloatLanes column =
            minimum(maximum(floor_of(u) - FloatLanes(1.0F), FloatLanes(0.0F)), last_column);
        const IntLanes index = to_int(column);
        index.store(columns_.data() + i);
        const FloatLanes from_first = u - column;
        const FloatLanes t = from_first - FloatLanes(1.0F);
        const FloatLanes before = t - FloatLanes(1.0F);
        const FloatLanes far = FloatLanes(2.0F) - t;
        const FloatLanes inner = from_first * far;
        const FloatLanes outer = t * before;
        FloatLanes weight[4] = {outer * far * FloatLanes(1.0F / 6),
                                FloatLanes(-0.5F) * inner * before, inner * t * FloatLanes(0.5F),
                                outer * from_first * FloatLanes(1.0F / 6)};
        const FloatMask is_steep = gather(steep_.data(), index) > FloatLanes(0.0F);
        if (any(is_steep)) {
            const FloatLanes inside =
                minimum(maximum(from_first, FloatLanes(0.0F)), FloatLanes(3.0F));
            for (std::size_t k = 0; k < 4; ++k) {
                const FloatLanes away = absolute(inside - FloatLanes(static_cast<float>(k)));
                weight[k] =
                    select(is_steep, maximum(FloatLanes(1.0F) - away, FloatLanes(0.0F)), weight[k]);
            }
        }
        for (std::size_t k = 0; k < 4; ++k) weight[k].store(cubic_.data() + k * room_ + i);
        const FloatLanes there = centre + width * x;
        store_powers(turn_cosine * along - turn_sine * cosine,
                     (FloatLanes(1.0F) - there) * (FloatLanes(1.0F) + there), i);
    }
}

// Adds to sum[sun] the rows at the suns' places.
template <bool kIsFirst>
void LevelPass::add_rows(std::size_t quads, MomentBlock* sum) const {
    for (std::size_t i = 0; i < suns_; ++i) {
        const MomentBlock* row = rows_.data() + static_cast<std::size_t>(columns_[i]) * quads_;
        const Block w0 = Block::all(cubic_[i]);
        const Block w1 = Block::all(cubic_[room_ + i]);
        const Block w2 = Block::all(cubic_[2 * room_ + i]);
        const Block w3 = Block::all(cubic_[3 * room_ + i]);
        Block total = kIsFirst ? Block::all(0) : Block::load(sum[i]);
        for (std::size_t q = 0; q < quads; ++q) {
            const MomentBlock* at = row + q;
            const Block value =
                (w0 * Block::load(at[0]) + w1 * Block::load(at[quads_])) +
                (w2 * Block::load(at[2 * quads_]) + w3 * Block::load(at[3 * quads_]));
            total = total + spread_.over_channels(powers_.data() + (q * room_ + i) * kQuad) * value;
        }
        total.store(sum[i]);
    }
}

void LevelPass::add_node(const LevelTransport& transport, const TransportNode& node) {
    const MomentBlock* weights = transport.weights.data() + node.weights;
    if (node.ground) {
        gather_ground(*weights);
    } else {
        gather_rows(node, weights);
    }
    const std::size_t set = static_cast<std::size_t>(node.azimuths) == azimuths_of(0) ? 0 : 1;
    const std::size_t quads = node.ground ? 1 : quads_;
    for (std::size_t j = 0; j < azimuths_of(set); ++j) {
        place_suns(node, azimuth_cosines_[set][j]);
        MomentBlock* sum = along_[set].data() + j * suns_;
        used_[set] ? add_rows<false>(quads, sum) : add_rows<true>(quads, sum);
    }
    used_[set] = true;
}

// Adds the moments of the light along a ray.
void LevelPass::add_ray(const TransportRay& ray, double* sky_irradiance) {
    const std::size_t blocks = block_count(light_.degree);
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(light_.degree)));
    zenith_harmonics(light_.degree, ray.mu, harmonics.data());
    const double solid_angle = 4 * std::numbers::pi * ray.weight;
    std::vector<float> factors(blocks * kQuad);
    for_each_block(light_.degree, [&](std::size_t block, int l, int least) {
        for (int m = least; m <= l && m < least + static_cast<int>(kQuad); ++m) {
            factors[block * kQuad + static_cast<std::size_t>(m - least)] = static_cast<float>(
                solid_angle * harmonics[static_cast<std::size_t>(moment_index(l, m))]);
        }
    });
    for (std::size_t i = 0; i < suns_; ++i) {
        // The sums over orders, by azimuth.
        for (std::size_t set = 0; set < 2; ++set) {
            for (std::size_t j = 0; used_[set] && j < azimuths_of(set); ++j) {
                float* at = along_[set][j * suns_ + i].values;
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    at[c] = (at[c] + at[c + 4]) + (at[c + 8] + at[c + 12]);
                }
            }
        }
        std::size_t block = 0;
        for (std::size_t q = 0; q < quads_; ++q) {
            Block mean = Block::all(0);
            for (std::size_t set = 0; set < 2; ++set) {
                for (std::size_t j = 0; used_[set] && j < azimuths_of(set); ++j) {
                    const float* weight = fourier_[set].data() + (j * quads_ + q) * kQuad;
                    mean = mean + spread_.over_channels(weight) *
                                      spread_.over_orders(along_[set][j * suns_ + i].values);
                }
            }
            if (q == 0 && sky_irradiance && ray.mu > 0) {
                MomentBlock first;
                mean.store(first);
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    sky_irradiance[i * kChannelSlots + c] += solid_angle * ray.mu * first.values[c];
                }
            }
            for (std::size_t l = q * kQuad; l < orders_; ++l, ++block) {
                MomentBlock& to = sums_[i * blocks + block];
                (Block::load(to) + spread_.over_channels(factors.data() + block * kQuad) * mean)
                    .store(to);
            }
        }
    }
}

// Moments of order m are kept over sin^m theta_s.
void LevelPass::write(double* out) const {
    for (std::size_t i = 0; i < suns_; ++i) {
        const double cosine = axis_.cosines[i];
        const double inverse = 1 / square_root((1 - cosine) * (1 + cosine));
        std::vector<double> factors = {1};
        while (factors.size() < orders_) factors.push_back(factors.back() * inverse);
        const MomentBlock* from = sums_.data() + i * light_.sun_size();
        double* to =
            out + i * static_cast<std::size_t>(moment_count(light_.degree)) * kChannelSlots;
        for_each_block(light_.degree, [&](std::size_t block, int l, int least) {
            for (int m = least; m <= l && m < least + static_cast<int>(kQuad); ++m) {
                const auto k = static_cast<std::size_t>(m - least);
                for (std::size_t c = 0; c < kChannelSlots; ++c) {
                    to[static_cast<std::size_t>(moment_index(l, m)) * kChannelSlots + c] =
                        factors[static_cast<std::size_t>(m)] *
                        from[block].values[k * kChannelSlots + c];
                }
            }
        });
    }
}

void LevelPass::apply(const LevelTransport& transport, double* out, double* sky_irradiance) {
    if (sky_irradiance) std::fill(sky_irradiance, sky_irradiance + suns_ * kChannelSlots, 0.0);
    for (const TransportRay& ray : transport.rays) {
        for (bool& used : used_) used = false;
        for (const TransportNode& node : ray.nodes) add_node(transport, node);
        add_ray(ray, sky_irradiance);
    }
    write(out);
}

void ApplyTransport(const LevelTransport& transport, const SunAxis& suns,
                    const std::vector<double>& steep, const BlockedLight& light, double* out,
                    double* sky_irradiance) {
    LevelPass(suns, steep, light).apply(transport, out, sky_irradiance);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(ApplyTransport);

void apply_transport(const LevelTransport& transport, const SunAxis& suns,
                     const std::vector<double>& steep, const BlockedLight& light, double* out,
                     double* sky_irradiance) {
    assert(light.suns == suns.count() && steep.size() >= suns.cosines.size() - 3);
    HWY_DYNAMIC_DISPATCH(ApplyTransport)(transport, suns, steep, light, out, sky_irradiance);
}

}  // namespace skybake
#endif  // HWY_ONCE
