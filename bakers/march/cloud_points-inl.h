// The points of a march at which light is looked up: how they are chosen, and the light that they add to
// their rays.
//
// The file is included once per target (see Highway's foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_MARCH_CLOUD_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_MARCH_CLOUD_POINTS_INL_H_
#undef SKYBAKE_BAKERS_MARCH_CLOUD_POINTS_INL_H_
#else
#define SKYBAKE_BAKERS_MARCH_CLOUD_POINTS_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/air/particles/phase_function-inl.h"
#include "bakers/march/cloud_path-inl.h"
#include "bakers/march/cloud_rays.h"
#include "bakers/march/light_in_cloud.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The points where light is looked up. They are collected while rays are marched and evaluated
// together.
struct LightPoints {
    std::vector<float> distance;        // along the ray, in metres
    std::vector<float> x, y, z;         // in voxels, within the copy of the volume
    std::vector<float> tile_x, tile_y;  // where that begins
    std::vector<float> weight;          // the share of its light that reaches the eye
    std::vector<float> jitter;          // of samples towards the sun
    std::vector<float> extinction;      // at the point, in 1/m
    std::vector<float> width;           // optical depth of what the point stands for, along the ray
    std::vector<float> tau;             // optical depth towards the sun
    std::vector<float> beyond;  // the part of it that other layers have; set where light is solved
    std::vector<std::uint32_t> ray;

    std::size_t size() const { return jitter.size(); }
};

// Finds where points are from their distances along rays.
inline void place_points(const CloudMarch& march, const RayBlock& rays, LightPoints& points) {
    const std::size_t count = points.size();
    for (auto* values : {&points.x, &points.y, &points.z, &points.tile_x, &points.tile_y}) {
        values->resize(count + FloatLanes::kCount);
    }
    for (std::size_t first = 0; first < count; first += FloatLanes::kCount) {
        alignas(64) float along[4][FloatLanes::kCount] = {};
        for (std::size_t i = 0; i < std::min(FloatLanes::kCount, count - first); ++i) {
            for (std::size_t a = 0; a < 3; ++a) {
                along[a][i] = rays.direction[a][points.ray[first + i]];
            }
            along[3][i] = points.distance[first + i];
        }
        const CloudPath path{*march.medium,
                             FloatLanes(march.origin[0]),
                             FloatLanes(march.origin[1]),
                             FloatLanes(march.origin[2]),
                             FloatLanes::load(along[0]),
                             FloatLanes::load(along[1]),
                             FloatLanes::load(along[2]),
                             {}};
        Place at = path.place(FloatLanes::load(along[3]));
        // Solved light is that of the copy whose cloud is seen.
        if (march.solved != nullptr && march.medium->variation.varies()) {
            const Place own = at;
            varied_lookup(*march.medium, own, zero_unless(own.within, own.z), own.within, &at);
        }
        at.x.store(&points.x[first]);
        at.y.store(&points.y[first]);
        at.z.store(&points.z[first]);
        at.tile_x.store(&points.tile_x[first]);
        at.tile_y.store(&points.tile_y[first]);
    }
}

constexpr float kPi = 3.14159265F;

// The values b^n p_n of the octaves of sun_scattering, for the angle of each lane.
struct OctaveLanes {
    FloatLanes value[kOctaves];
};

HWY_INLINE FloatLanes henyey_greenstein(double g, FloatLanes offset) {
    return FloatLanes(static_cast<float>((1 - g) * (1 + g) / 4)) /
           (FloatLanes(kPi) * henyey_greenstein_denominator(static_cast<float>(g), offset,
                                                            FloatLanes(2.0F) - offset));
}

HWY_INLINE OctaveLanes octaves_at(const CloudMarch& march, FloatLanes offset) {
    OctaveLanes lanes;
    const FloatLanes u = FloatLanes(1.0F) - offset;
    for (std::size_t n = 0; n < kOctaves; ++n) {
        const CloudPhase& phase = march.octaves[n].phase;
        const double brightness = march.octaves[n].brightness;
        const double g = phase.draine_g;
        const double alpha = phase.draine_alpha;
        const double draine_scale =
            brightness * phase.draine_share / (1 + alpha * (1 + 2 * g * g) / 3);
        const FloatLanes draine =
            henyey_greenstein(g, offset) *
            (FloatLanes(1.0F) + FloatLanes(static_cast<float>(alpha)) * u * u) *
            FloatLanes(static_cast<float>(draine_scale));
        const FloatLanes forward =
            henyey_greenstein(phase.hg_g, offset) *
            FloatLanes(static_cast<float>(brightness * (1 - phase.draine_share)));
        lanes.value[n] = draine + forward;
    }
    return lanes;
}

// Calculates exp(-tau / 2^n) for the last octave; squaring it repeatedly gives the octaves before.
HWY_INLINE FloatLanes scattered_sunlight(const OctaveLanes& octaves, FloatLanes tau) {
    static_assert(kOctaveHalving == 0.5);
    FloatLanes through =
        exponential_of_negative(tau * FloatLanes(-1.0F / static_cast<float>(1 << (kOctaves - 1))));
    FloatLanes sum(0.0F);
    for (std::size_t n = kOctaves; n-- > 0;) {
        sum = sum + octaves.value[n] * through;
        through = through * through;
    }
    return sum;
}

// Looks up a share of diffuse light at places in the volume.
HWY_INLINE FloatLanes share_at(const std::array<int, 3>& voxels, const PaddedVolume& shares,
                               FloatLanes x, FloatLanes y, FloatLanes z) {
    const auto scaled = [&](FloatLanes value, std::size_t axis) HWY_ATTR {
        const double scale = static_cast<double>(shares.size[axis]) / voxels[axis];
        return minimum(value * FloatLanes(static_cast<float>(scale)),
                       FloatLanes(static_cast<float>(shares.size[axis])));
    };
    return lookup(shares, scaled(x, 0), scaled(y, 1), scaled(z, 2));
}

// Adds the light of each point to its ray, in the order of points.
class Lighting {
  public:
    Lighting(const CloudMarch& march, const RayBlock& rays) : march_(march), rays_(rays) {
        if (march.solved != nullptr) return;
        for (std::size_t i = 0; i < RayBlock::kCount; i += FloatLanes::kCount) {
            const OctaveLanes octaves = octaves_at(march, FloatLanes::load(&rays.sun_offset[i]));
            for (std::size_t n = 0; n < kOctaves; ++n) octaves.value[n].store(&octaves_[n][i]);
        }
    }

    void add(const LightPoints& points, RayResults& results) const {
        if (march_.solved != nullptr) return add_solved(points, results);
        for (std::size_t first = 0; first < points.size(); first += FloatLanes::kCount) {
            add_packet(points, first, results);
        }
    }

  private:
    // Points come in the order of packets of rays, so each ray is prepared where a point of it comes first.
    void add_solved(const LightPoints& points, RayResults& results) const {
        const LightInCloud& light = *march_.solved;
        const CloudMedium& medium = *march_.medium;
        std::vector<LitRay> rays(RayBlock::kCount);
        std::array<bool, RayBlock::kCount> known{};
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::size_t ray = points.ray[i];
            if (!known[ray]) {
                glm::dvec3 look;
                for (std::size_t a = 0; a < 3; ++a) {
                    look[a] = double{rays_.direction[a][ray]} * medium.meters_per_voxel(a);
                }
                rays[ray] = lit_ray(light, look, double{rays_.sun_offset[ray]});
                known[ray] = true;
            }
            LitPoint point{{points.x[i], points.y[i], points.z[i]},
                           points.tau[i],
                           points.beyond[i],
                           points.width[i]};
            for (std::size_t a = 0; a < 3; ++a) {
                point.place[a] /= static_cast<float>(medium.volume.size[a]);
            }
            const PointLight found = light_of(light, rays[ray], point);
            const float weight = points.weight[i];
            const float high = weight * found.sun * point.place[2];
            results.sun_at_base[ray] += weight * found.sun - high;
            results.sun_at_top[ray] += high;
            results.from_sky[ray] += weight * found.sky;
            results.from_ground[ray] += weight * found.ground;
        }
        // Near the sun, behind thick cloud, parts below 0 cancel brighter ones before them; steps that miss some of
        // a cloud's edge can leave less than nothing.
        for (std::size_t ray = 0; ray < RayBlock::kCount; ++ray) {
            if (!(results.sun_at_base[ray] + results.sun_at_top[ray] < 0)) continue;
            results.sun_at_base[ray] = 0;
            results.sun_at_top[ray] = 0;
        }
    }

    void add_packet(const LightPoints& points, std::size_t first, RayResults& results) const {
        alignas(64) float x[FloatLanes::kCount] = {};
        alignas(64) float y[FloatLanes::kCount] = {};
        alignas(64) float z[FloatLanes::kCount] = {};
        alignas(64) float tau[FloatLanes::kCount] = {};
        alignas(64) float octaves[kOctaves][FloatLanes::kCount] = {};
        const std::size_t count = std::min(FloatLanes::kCount, points.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            x[i] = points.x[first + i];
            y[i] = points.y[first + i];
            z[i] = points.z[first + i];
            tau[i] = points.tau[first + i];
            for (std::size_t n = 0; n < kOctaves; ++n) {
                octaves[n][i] = octaves_[n][points.ray[first + i]];
            }
        }
        OctaveLanes lanes;
        for (std::size_t n = 0; n < kOctaves; ++n) lanes.value[n] = FloatLanes::load(octaves[n]);
        const std::array<int, 3>& voxels = march_.medium->volume.size;
        const FloatLanes at_x = FloatLanes::load(x);
        const FloatLanes at_y = FloatLanes::load(y);
        const FloatLanes at_z = FloatLanes::load(z);
        const FloatLanes sunlight = scattered_sunlight(lanes, FloatLanes::load(tau));
        const FloatLanes height = at_z * FloatLanes(1.0F / static_cast<float>(voxels[2]));
        const FloatLanes high = sunlight * height;
        (sunlight - high).store(x);
        high.store(y);
        share_at(voxels, march_.diffuse->from_sky, at_x, at_y, at_z).store(z);
        share_at(voxels, march_.diffuse->from_ground, at_x, at_y, at_z).store(tau);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t ray = points.ray[first + i];
            const float weight = points.weight[first + i];
            results.sun_at_base[ray] += weight * x[i];
            results.sun_at_top[ray] += weight * y[i];
            results.from_sky[ray] += 0.5F * weight * z[i];
            results.from_ground[ray] += 0.5F * weight * tau[i];
        }
    }

    const CloudMarch& march_;
    const RayBlock& rays_;
    alignas(64) std::array<RayBlock::Floats, kOctaves> octaves_;
};

// Samples in cloud as their rays meet them: the number k, the distance, the extinction, the optical depth, and
// the share of light from the eye that ends in the sample.
struct LitSample {
    FloatLanes k, distance, extinction, depth, weight;
};

// Gathers the samples of a packet of rays into groups, each of which has the light of one point: the mean
// place of its samples, weighted by what the eye sees of them, where the light is that of all of them if it
// changes evenly. A group ends where the eye would see more of it than kSharedWeight, or where it would be
// longer than kSharedSteps. A sample that shows more than that is a group alone.
class PointCollector {
  public:
    PointCollector(const RayBlock& rays, LightPoints& points, std::size_t first_ray)
        : rays_(rays), points_(points), first_ray_(first_ray) {}

    void add(const LitSample& sample, FloatMask lit) {
        const FloatMask open = lit & (FloatLanes(0.0F) < weight_);
        const FloatMask joins = (weight_ + sample.weight <= FloatLanes(kSharedWeight)) &
                                (sample.k < first_ + FloatLanes(kSharedSteps));
        const FloatMask ends = and_not(open, joins);
        if (any(ends)) end(ends);
        const FloatLanes weight = zero_unless(lit, sample.weight);
        first_ = select(lit & (weight_ <= FloatLanes(0.0F)), sample.k, first_);
        weight_ = weight_ + weight;
        distance_ = distance_ + weight * sample.distance;
        extinction_ = extinction_ + weight * sample.extinction;
        depth_ = depth_ + zero_unless(lit, sample.depth);
    }
    void end_all() { end(FloatLanes(0.0F) < weight_); }

  private:
    void end(FloatMask groups) {
        alignas(64) float weights[FloatLanes::kCount];
        alignas(64) float distances[FloatLanes::kCount];
        alignas(64) float extinctions[FloatLanes::kCount];
        alignas(64) float depths[FloatLanes::kCount];
        zero_unless(groups, weight_).store(weights);
        distance_.store(distances);
        extinction_.store(extinctions);
        depth_.store(depths);
        for (std::size_t lane = 0; lane < FloatLanes::kCount; ++lane) {
            const float weight = weights[lane];
            if (!(weight > 0)) continue;
            points_.weight.push_back(weight);
            points_.distance.push_back(distances[lane] / weight);
            points_.extinction.push_back(extinctions[lane] / weight);
            points_.width.push_back(depths[lane]);
            points_.ray.push_back(static_cast<std::uint32_t>(first_ray_ + lane));
            points_.jitter.push_back(rays_.light_jitter[first_ray_ + lane]);
        }
        const FloatLanes none(0.0F);
        weight_ = select(groups, none, weight_);
        distance_ = select(groups, none, distance_);
        extinction_ = select(groups, none, extinction_);
        depth_ = select(groups, none, depth_);
    }

    const RayBlock& rays_;
    LightPoints& points_;
    std::size_t first_ray_;
    // The group of each ray: its first sample, and sums over all of them.
    FloatLanes first_ = FloatLanes(0.0F);
    FloatLanes weight_ = FloatLanes(0.0F);
    FloatLanes distance_ = FloatLanes(0.0F);
    FloatLanes extinction_ = FloatLanes(0.0F);
    FloatLanes depth_ = FloatLanes(0.0F);
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_MARCH_CLOUD_POINTS_INL_H_
