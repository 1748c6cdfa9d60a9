#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/march/cloud_rays.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "bakers/march/cloud_rays.h"

#include "bakers/march/cloud_leap-inl.h"
#include "bakers/march/cloud_path-inl.h"
#include "bakers/march/cloud_points-inl.h"
#include "bakers/march/sun_march-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {
namespace {

// The march of a packet of rays through one layer.
class LayerPacket {
  public:
    LayerPacket(const CloudMarch& march, const RayBlock& rays, std::size_t first,
                LightPoints& points)
        : march_(march),
          path_{*march.medium,
                FloatLanes(march.origin[0]),
                FloatLanes(march.origin[1]),
                FloatLanes(march.origin[2]),
                FloatLanes::load(&rays.direction[0][first]),
                FloatLanes::load(&rays.direction[1][first]),
                FloatLanes::load(&rays.direction[2][first]),
                {FloatLanes::load(&rays.jitter[first]), march.step_m, 1 / march.step_m,
                 march.growth}},
          pace_{pace_of(path_.direction_x), pace_of(path_.direction_y), pace_of(path_.direction_z)},
          collector_(rays, points, first),
          end_(FloatLanes::load(&rays.end[first])),
          share_(march.solved != nullptr ? static_cast<float>(march.solved->share) : 1.0F),
          progress_{FloatLanes::load(&rays.first[first]), FloatLanes(1.0F)} {}

    FloatMask going() const { return progress_.k < end_; }
    // The distance of the next sample.
    FloatLanes next_distance() const { return path_.samples.distance(progress_.k); }

    // Takes a sample in the lanes `taking`, or leaps, and attenuates what is behind it.
    void advance(FloatMask taking, FloatLanes& transmittance, FetchCounts& counts) {
        const FloatLanes one(1.0F);
        const FloatLanes waiting = progress_.k;
        progress_.k = zero_unless(taking, progress_.k);
        const FloatLanes k = progress_.k;
        const FloatLanes t = path_.samples.distance(k);
        const Place at = path_.place(t);
        const FloatMask before = and_not(taking, at.within);
        progress_.k = select(before, k + one, k);
        FloatMask sampling = taking & at.within;
        if (march_.leaping) {
            sampling = leap_or_look(path_, pace_, at, sampling, end_, progress_, counts.cells);
        }
        if (any(sampling)) {
            counts.samples += count_of(sampling);
            const FloatLanes sigma = faded(extinction(*march_.medium, at, sampling), t);
            step_on(sampling, sigma, progress_);
            const FloatMask lit = FloatLanes(0.0F) < sigma;
            if (any(lit)) add(k, t, sigma, lit, transmittance);
        }
        progress_.k = select(taking, progress_.k, waiting);
    }

    void store(std::size_t first, RayResults& results) {
        collector_.end_all();
        opacity_.store(&results.opacity[first]);
        distance_.store(&results.distance_m[first]);
    }

  private:
    void add(FloatLanes k, FloatLanes t, FloatLanes sigma, FloatMask lit,
             FloatLanes& transmittance) {
        const FloatLanes depth = sigma * path_.samples.length(k);
        const FloatLanes through = exponential_of_negative(depth * FloatLanes(0 - share_));
        const FloatLanes weight = transmittance * (FloatLanes(1.0F) - through);
        collector_.add({k, t, sigma, depth, weight}, lit);
        opacity_ = opacity_ + zero_unless(lit, weight);
        distance_ = distance_ + zero_unless(lit, weight * t);
        transmittance = select(lit, transmittance * through, transmittance);
    }

    FloatLanes faded(FloatLanes sigma, FloatLanes t) const {
        if (march_.fade_to_m == 0) return sigma;
        const FloatLanes scale(1 / (march_.fade_to_m - march_.fade_from_m));
        const FloatLanes x =
            maximum(minimum((FloatLanes(march_.fade_to_m) - t) * scale, FloatLanes(1.0F)),
                    FloatLanes(0.0F));
        return sigma * (x * x * (FloatLanes(3.0F) - (x + x)));
    }

    const CloudMarch& march_;
    CloudPath path_;
    Pace pace_;
    PointCollector collector_;
    FloatLanes end_;
    float share_;  // of the extinction, that rays meet
    Progress progress_;
    FloatLanes opacity_ = FloatLanes(0.0F);
    FloatLanes distance_ = FloatLanes(0.0F);
};

// Marches a packet of rays through all layers: again and again, those layers of a ray go on whose next
// sample is nearest. `packets` is room for one packet for each layer.
void march_packet(std::span<const CloudMarch> layers, std::span<const RayBlock> rays,
                  std::size_t first, std::span<LayerPacket> packets, std::span<LightPoints> points,
                  std::span<RayResults> results, FetchCounts& counts) {
    for (std::size_t l = 0; l < layers.size(); ++l) {
        std::construct_at(&packets[l], layers[l], rays[l], first, points[l]);
    }
    FloatLanes transmittance(1.0F);
    for (bool busy = true; busy;) {
        FloatLanes nearest(0x1p60F);
        for (const LayerPacket& packet : packets) {
            nearest = select(packet.going(), minimum(nearest, packet.next_distance()), nearest);
        }
        busy = false;
        for (LayerPacket& packet : packets) {
            const FloatMask taking = packet.going() & (packet.next_distance() <= nearest) &
                                     (FloatLanes(kOpaque) <= transmittance);
            if (!any(taking)) continue;
            packet.advance(taking, transmittance, counts);
            busy = true;
        }
    }
    for (std::size_t l = 0; l < layers.size(); ++l) {
        packets[l].store(first, results[l]);
        transmittance.store(&results[l].transmittance[first]);
    }
}

// The march towards the sun through a layer from points outside of it.
const CloudMarch& from_elsewhere(const CloudMarch& layer) {
    return layer.far_light.empty() ? layer : layer.far_light.front();
}

// Adds the optical depths from where marches of layer.own_samples end, half a step beyond their last samples.
void add_solved_depths(const CloudMarch& layer, LightPoints& points) {
    const std::array<int, 3>& voxels = layer.medium->volume.size;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float length_m = (layer.own_samples - 0.5F + points.jitter[i]) * layer.light_step_m;
        const std::array<float, 3> from = {points.x[i], points.y[i], points.z[i]};
        std::array<float, 3> place;
        for (std::size_t a = 0; a < 3; ++a) {
            place[a] =
                (from[a] + length_m * layer.light_direction[a]) / static_cast<float>(voxels[a]);
        }
        points.tau[i] += sun_depth_at(*layer.solved, place);
    }
}

// Marches towards the sun from points of the same layer.
void march_own_layer(const CloudMarch& layer, LightPoints& points, FetchCounts& counts) {
    SunMarches(layer, own_frame(layer), points, counts).run();
    if (layer.solved != nullptr && layer.own_samples > 0) return add_solved_depths(layer, points);
    for (const CloudMarch& far : layer.far_light) {
        PointFrame frame = frame_of(*layer.medium, far);
        frame.begin_m = far.own_begin_m;
        frame.samples = far.own_samples;
        SunMarches(far, frame, points, counts).run();
    }
}

}  // namespace

void march_all(std::span<const CloudMarch> layers, std::span<const RayBlock> rays,
               std::span<RayResults> results, FetchCounts& counts) {
    std::vector<LightPoints> points(layers.size());
    for (RayResults& result : results) result = {};
    // Vectors need an alignment that the memory of std::vector does not have.
    static_assert(std::is_trivially_destructible_v<LayerPacket>);
    const auto room = hwy::AllocateAligned<std::byte>(layers.size() * sizeof(LayerPacket));
    const std::span<LayerPacket> packets(reinterpret_cast<LayerPacket*>(room.get()), layers.size());
    for (std::size_t first = 0; first < RayBlock::kCount; first += FloatLanes::kCount) {
        march_packet(layers, rays, first, packets, points, results, counts);
    }
    for (std::size_t l = 0; l < layers.size(); ++l) {
        if (points[l].size() == 0) continue;
        place_points(layers[l], rays[l], points[l]);
        points[l].tau.assign(points[l].size(), 0.0F);
        for (std::size_t m = 0; m < layers.size(); ++m) {
            if (m == l) continue;
            const CloudMarch& march = from_elsewhere(layers[m]);
            SunMarches(march, frame_of(*layers[l].medium, march), points[l], counts).run();
        }
        if (layers[l].solved != nullptr) points[l].beyond = points[l].tau;
        march_own_layer(layers[l], points[l], counts);
        Lighting(layers[l], rays[l]).add(points[l], results[l]);
    }
}

void depths_of_all(std::span<const CloudMarch> layers, std::span<const SunlitPoint> points,
                   std::vector<float>& depths, FetchCounts& counts) {
    LightPoints light;
    for (const SunlitPoint& point : points) {
        light.x.push_back(point.x_m);
        light.y.push_back(point.y_m);
        light.z.push_back(point.altitude_m);
        light.jitter.push_back(point.jitter);
    }
    light.tile_x.assign(points.size(), 0.0F);
    light.tile_y.assign(points.size(), 0.0F);
    light.tau.assign(points.size(), 0.0F);
    for (const CloudMarch& layer : layers) {
        SunMarches(layer, frame_from({1, 1, 1}, 0, layer), light, counts).run();
    }
    depths = std::move(light.tau);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(march_all);
HWY_EXPORT(depths_of_all);

void march_cloud_rays(std::span<const CloudMarch> layers, std::span<const RayBlock> rays,
                      std::span<RayResults> results, FetchCounts& counts) {
    HWY_DYNAMIC_DISPATCH(march_all)(layers, rays, results, counts);
}

std::vector<float> depths_towards_sun(std::span<const CloudMarch> layers,
                                      std::span<const SunlitPoint> points, FetchCounts& counts) {
    std::vector<float> depths;
    HWY_DYNAMIC_DISPATCH(depths_of_all)(layers, points, depths, counts);
    return depths;
}

}  // namespace skybake
#endif  // HWY_ONCE
