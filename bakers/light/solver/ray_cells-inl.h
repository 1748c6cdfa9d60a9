// Sunlight along the rays of one zenith angle and all azimuths, towards all suns: what each layer sends
// from it to the rays' end, summed cell by cell, in floats.
//
// A vector holds the four channels of one to four suns beside each other, as they lie in memory: all
// channels in a column of a table of sunlight are one load. Places are doubles, since a sun's height over
// the shadow's edge is a small difference.
#if defined(SKYBAKE_BAKERS_LIGHT_SOLVER_RAY_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_LIGHT_SOLVER_RAY_CELLS_INL_H_
#undef SKYBAKE_BAKERS_LIGHT_SOLVER_RAY_CELLS_INL_H_
#else
#define SKYBAKE_BAKERS_LIGHT_SOLVER_RAY_CELLS_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "bakers/air/transmittance_row-inl.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/channel_floats-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Returns the mean of an exponential between two values, as a share of their arithmetic mean:
// r / artanh r, where r is half their difference over that mean. Pade's fraction of it is 1e-4 off
// where the values differ by a factor of 5, and 0.03 off where they differ by 50.
HWY_INLINE FloatLanes exponential_share(FloatLanes first, FloatLanes last) {
    const FloatLanes r = (last - first) / maximum(last + first, FloatLanes(1e-30F));
    const FloatLanes q = r * r;
    return (FloatLanes(945.0F) + q * (FloatLanes(225.0F) * q - FloatLanes(1050.0F))) /
           (FloatLanes(945.0F) + q * (FloatLanes(64.0F) * q - FloatLanes(735.0F)));
}

// A point of the rays, with the sunlight at its altitude.
struct CellEnd {
    double along_km;  // r' mu_s' = along mu_s + across sin theta_s cos phi
    double across_km;
    double edge_km;  // the sun is up from here on
    SunlightRow sunlight;
};

// The cells of one ray after the other, at all azimuths.
class RayCells {
  public:
    // `cosines` and `sines` are those of the suns' zenith angles.
    RayCells(const SkyMedium& medium, const TransmittanceField& sunlight,
             const std::vector<double>& cosines, const std::vector<double>& sines,
             const std::vector<double>& azimuth_cosines)
        : medium_(medium),
          layers_(medium.layers),
          field_(sunlight),
          cosines_(cosines),
          sines_(sines),
          azimuth_cosines_(azimuth_cosines),
          suns_(sines_.size()),
          row_(static_cast<std::size_t>(sunlight.row_size())),
          row_floats_(row_.size()),
          table_(static_cast<std::size_t>(sunlight.columns() + 2) * kChannelSlots),
          places_(suns_),
          fractions_(suns_ + FloatLanes::kCount),
          heights_(suns_ + FloatLanes::kCount),
          heights_before_(azimuth_cosines_.size() * suns_ + FloatLanes::kCount),
          light_before_(azimuth_cosines_.size() * suns_ * kChannelSlots),
          sums_(azimuth_cosines_.size() * (layers_.size() + 1) * suns_ * kChannelSlots) {}

    // Sums what a ray from a radius brings from the suns from `first` to before `last`, whole vectors of
    // them.
    void sum(double r_km, const FanRay& ray, std::size_t first, std::size_t last) {
        first_ = first;
        last_ = last;
        std::ranges::fill(sums_, 0.0F);
        for (std::size_t k = 0; k < ray.points.size(); ++k) {
            const double edge_before_km = end_.edge_km;
            const ChannelFloats grazing_before = grazing_;
            place_end(r_km, ray, ray.points[k].distance_km, ray.points[k].altitude_km);
            set_weights(ray, k);
            for (std::size_t j = 0; j < azimuth_cosines_.size(); ++j) {
                place_suns(j, false);
                add_cell(j, static_cast<float>(edge_before_km), grazing_before);
            }
        }
        if (ray.hits_ground) add_ground(r_km, ray);
    }

    // Reads the sums of a layer, or after the last one of the ground, for a vector of suns.
    HWY_INLINE void read(std::size_t azimuth, std::size_t layer, std::size_t sun, Lanes* sums) {
        const hn::Rebind<float, Lanes::Tag> floats;
        hn::Vec<decltype(floats)> channels[kChannelSlots];
        hn::LoadInterleaved4(floats, this->sums(azimuth, layer, sun), channels[0], channels[1],
                             channels[2], channels[3]);
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            sums[c] = Lanes(hn::PromoteTo(Lanes::Tag(), channels[c]));
        }
    }

  private:
    // Adds what the ground sends where the ray ends.
    void add_ground(double r_km, const FanRay& ray) {
        place_end(r_km, ray, ray.length_km, 0);
        const ChannelFloats sent =
            floats_of(ray.end_transmittance * medium_.air.ground_albedo * std::numbers::inv_pi);
        for (std::size_t j = 0; j < azimuth_cosines_.size(); ++j) {
            place_suns(j, true);
            float* sum = sums(j, layers_.size(), 0);
            for (std::size_t n = begin_number(); n < end_number(); n += FloatLanes::kCount) {
                (FloatLanes::load(sum + n) +
                 for_all_suns(sent, n) * for_all_channels(heights_.data(), n) * sunlight_of(n))
                    .store(sum + n);
            }
        }
    }

    void place_end(double r_km, const FanRay& ray, double distance_km, double altitude_km) {
        end_ = {r_km + distance_km * ray.mu, distance_km * ray.sine,
                -horizon_distance_km(field_.shell(), altitude_km),
                sunlight_row(field_, altitude_km, row_.data())};
        const std::size_t first = first_number();
        combine_row<Lanes>(field_, altitude_km, row_.data(), static_cast<int>(first));
        const hn::Rebind<float, Lanes::Tag> floats;
        for (std::size_t i = first; i < row_.size(); i += Lanes::kCount) {
            const Lanes x = Lanes::load(row_.data() + i);
            const Lanes light = zero_unless(x >= Lanes(kDarkest), x);
            hn::StoreU(hn::DemoteTo(floats, light.v), floats, row_floats_.data() + i);
        }
        const auto channels = static_cast<std::size_t>(field_.channels());
        // Behind the channels lies light of the next column, which no layer and no ground weighs.
        for (std::size_t x = (first + channels - 1) / channels; x * kChannelSlots < table_.size();
             ++x) {
            std::copy_n(row_floats_.data() + x * channels, kChannelSlots,
                        table_.data() + x * kChannelSlots);
        }
        const auto last = static_cast<std::size_t>(field_.columns() - 1) * kChannelSlots;
        std::copy_n(table_.data() + last, kChannelSlots, grazing_.values.data());
    }

    // Returns where in a row, at a vector's beginning, columns of suns lie from: they fall as suns rise.
    std::size_t first_number() const {
        double highest = 0;
        for (std::size_t i = first_; i < last_; ++i) {
            highest = std::max(highest, cosines_[i] * end_.along_km + sines_[i] * end_.across_km);
        }
        const double column =
            column_towards(end_.sunlight, distance_to_top(end_.sunlight, highest));
        const auto before = static_cast<std::size_t>(std::max(column - 1, 0.0));
        return before * static_cast<std::size_t>(end_.sunlight.channels) / Lanes::kCount *
               Lanes::kCount;
    }

    // Takes the weights of sunlight at both ends of the cell up to a point, for each layer; none at the
    // first point.
    void set_weights(const FanRay& ray, std::size_t point) {
        near_.clear();
        far_.clear();
        for (std::size_t k = 0; point > 0 && k < layers_.size(); ++k) {
            near_.push_back(floats_of(ray.near[(point - 1) * layers_.size() + k]));
            far_.push_back(floats_of(ray.far[(point - 1) * layers_.size() + k]));
        }
    }

    // Finds the columns of all suns in the table, and their heights over the shadow's edge or, on the
    // ground, the cosines of their zenith angles.
    void place_suns(std::size_t azimuth, bool on_ground) {
        const hn::Rebind<float, Lanes::Tag> floats;
        const hn::Rebind<std::int32_t, Lanes::Tag> integers;
        const Lanes across(end_.across_km * azimuth_cosines_[azimuth]);
        const Lanes edge(end_.edge_km);
        for (std::size_t i = first_; i < last_; i += Lanes::kCount) {
            Lanes s = Lanes::load(cosines_.data() + i) * Lanes(end_.along_km) +
                      Lanes::load(sines_.data() + i) * across;
            Lanes height = s - edge;
            if (on_ground) {
                s = maximum(s, Lanes(0.0));
                height = s * Lanes(1 / field_.shell().ground_radius_km);
            }
            const Lanes column = column_towards(end_.sunlight, distance_to_top(end_.sunlight, s));
            const Lanes whole = floor_of(column);
            hn::StoreU(hn::DemoteTo(floats, height.v), floats, heights_.data() + i);
            hn::StoreU(hn::DemoteTo(floats, (column - whole).v), floats, fractions_.data() + i);
            hn::StoreU(hn::DemoteTo(integers, (whole * Lanes(double{kChannelSlots})).v), integers,
                       places_.data() + i);
        }
    }

    std::size_t begin_number() const { return first_ * kChannelSlots; }
    std::size_t end_number() const { return last_ * kChannelSlots; }

    HWY_INLINE FloatLanes sunlight_of(std::size_t number) const {
        const FloatLanes left = load_places(table_.data(), places_.data(), number);
        const FloatLanes right = load_places(table_.data() + kChannelSlots, places_.data(), number);
        return left + for_all_channels(fractions_.data(), number) * (right - left);
    }

    // Returns the mean of sunlight over a cell that is lit at one end. It is linear up to the shadow's edge.
    HWY_INLINE FloatLanes mean_to_edge(FloatLanes height, FloatLanes height_before,
                                       FloatLanes brighter, FloatLanes grazing,
                                       FloatLanes grazing_before) const {
        const FloatLanes low = minimum(height, height_before);
        const FloatLanes high = maximum(height, height_before);
        const FloatLanes lit = high / maximum(high - low, FloatLanes(1e-30F));  // 0 / 0 if dark
        const FloatLanes share =
            select(height_before >= FloatLanes(0.0F), lit, FloatLanes(1.0F) - lit);
        const FloatLanes at_edge = grazing_before + (grazing - grazing_before) * share;
        return zero_unless(high >= FloatLanes(0.0F), FloatLanes(0.5F) * lit * (brighter + at_edge));
    }

    void add_cell(std::size_t azimuth, float edge_before_km, const ChannelFloats& grazing_before) {
        const FloatLanes zero(0.0F);
        float* before = heights_before_.data() + azimuth * suns_;
        float* light_before = light_before_.data() + azimuth * suns_ * kChannelSlots;
        const FloatLanes edge(static_cast<float>(end_.edge_km));
        for (std::size_t n = begin_number(); n < end_number(); n += FloatLanes::kCount) {
            const FloatLanes height = for_all_channels(heights_.data(), n);
            const FloatLanes height_before = for_all_channels(before, n);
            const FloatMask up = height >= zero;
            FloatLanes last = any(up) ? zero_unless(up, sunlight_of(n)) : zero;
            FloatLanes first = FloatLanes::load(light_before + n);
            last.store(light_before + n);
            if (near_.empty() || !(any(up) || any(height_before >= zero))) continue;
            const FloatMask edge_inside = minimum(height, height_before) < zero;
            if (any(edge_inside)) {
                const FloatLanes mean =
                    mean_to_edge(height, height_before, maximum(first, last),
                                 for_all_suns(grazing_, n), for_all_suns(grazing_before, n));
                first = select(edge_inside, mean, first);
                last = select(edge_inside, mean, last);
            }
            const FloatMask by_day =
                (height + edge >= zero) & (height_before + FloatLanes(edge_before_km) >= zero);
            if (any(by_day)) {
                const FloatLanes share =
                    select(by_day, exponential_share(first, last), FloatLanes(1.0F));
                first = first * share;
                last = last * share;
            }
            for (std::size_t k = 0; k < layers_.size(); ++k) {
                if (!layers_[k].scatters) continue;
                float* sum = sums(azimuth, k, 0) + n;
                (FloatLanes::load(sum) +
                 (for_all_suns(near_[k], n) * first + for_all_suns(far_[k], n) * last))
                    .store(sum);
            }
        }
        std::copy(heights_.begin() + static_cast<std::ptrdiff_t>(first_),
                  heights_.begin() + static_cast<std::ptrdiff_t>(last_), before + first_);
    }

    float* sums(std::size_t azimuth, std::size_t layer, std::size_t sun) {
        return sums_.data() +
               ((azimuth * (layers_.size() + 1) + layer) * suns_ + sun) * kChannelSlots;
    }

    const SkyMedium& medium_;
    const std::vector<SkyLayer>& layers_;
    const TransmittanceField& field_;
    const std::vector<double>& cosines_;
    const std::vector<double>& sines_;
    const std::vector<double>& azimuth_cosines_;
    std::size_t suns_;
    std::size_t first_ = 0;
    std::size_t last_ = 0;
    CellEnd end_{};
    ChannelFloats grazing_{};          // sunlight that grazes the ground, at the end
    std::vector<ChannelFloats> near_;  // by layer; empty at the ray's beginning
    std::vector<ChannelFloats> far_;
    std::vector<double> row_;  // sunlight at the end's altitude, and the same in floats:
    std::vector<float> row_floats_, table_;
    std::vector<std::int32_t> places_;  // of each sun in the table, at the end
    std::vector<float> fractions_;
    std::vector<float> heights_;
    std::vector<float> heights_before_;  // [azimuth * suns + sun]
    std::vector<float> light_before_;    // [(azimuth * suns + sun) * channels + c]
    std::vector<float> sums_;            // of each layer, then of the ground
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_LIGHT_SOLVER_RAY_CELLS_INL_H_
