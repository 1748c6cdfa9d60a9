#include "bakers/plan/marched_cloud.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/pixel_type.h"
#include "bakers/march/cloud_light.h"
#include "bakers/march/forward_mapping.h"
#include "bakers/math/harmonics.h"

namespace skybake {

using cloud_light::CloudLayer;

namespace {

// A march ends where it sees less than this of what follows.
constexpr double kLeastSeen = 1e-3;
constexpr double kAlbedo = 1;

glm::dvec3 extent_m(const CloudLayer& layer) {
    return {layer.size[0] * layer.voxel_m[0], layer.size[1] * layer.voxel_m[1],
            layer.size[2] * layer.voxel_m[2]};
}

double extinction_at_share(const CloudLayer& layer, const glm::dvec3& place) {
    return cloud_light::extinction_at(
        layer, place * glm::dvec3(layer.size[0], layer.size[1], layer.size[2]));
}

// Returns the metres from a place to the face that a direction leads to.
double distance_to_face(const CloudLayer& layer, const glm::dvec3& place, const glm::dvec3& look) {
    const double shares = look.z > 0 ? 1 - place.z : place.z;
    return shares * extent_m(layer).z / std::fabs(look.z);
}

// Where the octaves' light at a sample comes from: the optical depth to the sun.
class SunDepth {
  public:
    SunDepth(const CloudWay& way, const CloudTextures& textures, const glm::dvec3& sun)
        : way_(way), textures_(textures), sun_(sun), values_(harmonics(sun)) {}

    double at(const glm::dvec3& place) const {
        if (way_.lighting == CloudLighting::march) return marched(place);
        if (way_.lighting == CloudLighting::depth) return textures_.depth->at(place);
        return std::fmax(sum_of_parts(textures_, values_, place), 0.0);
    }

    static double sum_of_parts(const CloudTextures& textures, const Harmonics& values,
                               const glm::dvec3& place) {
        double sum = 0;
        const double* factors = values.data();
        for (const StoredTexture* part : textures.parts) {
            sum += part->sum_at(place, factors);
            factors += part->channels();
        }
        return sum;
    }

  private:
    // Samples lie closer near the place: at squares of even shares of the way.
    double marched(const glm::dvec3& place) const {
        const double whole = distance_to_face(*textures_.layer, place, sun_);
        const glm::dvec3 per_meter = sun_ / extent_m(*textures_.layer);
        double depth = 0;
        for (int i = 0; i < way_.sun_samples; ++i) {
            const double share = (i + 0.5) / way_.sun_samples;
            const double width = 2 * share / way_.sun_samples;
            depth += width * extinction_at_share(*textures_.layer,
                                                 place + per_meter * (share * share * whole));
        }
        return depth * whole;
    }

    const CloudWay& way_;
    const CloudTextures& textures_;
    const glm::dvec3 sun_;
    const Harmonics values_;
};

// The light that the cloud sends towards the eye from a sample, over the scattering coefficient.
class SampleLight {
  public:
    SampleLight(const CloudWay& way, const CloudTextures& textures, const glm::dvec3& look,
                const glm::dvec3& sun)
        : way_(way),
          textures_(textures),
          depth_(way, textures, sun),
          offset_(glm::dot(look - sun, look - sun) / 2),
          cloud_phase_(cloud_phase(textures.layer->optics.particles)),
          octaves_(octave_phases(cloud_phase_)),
          phase_(kAlbedo * phase_value(cloud_phase_, offset_)),
          values_(harmonics(-look)) {
        if (way.lighting == CloudLighting::radiance) {
            share_ =
                cloud_light::scaled(cloud_light::scattering_of(cloud_phase_, kAlbedo), way.degree)
                    .extinction_share;
        }
    }

    // The extinction of the march over the cloud's.
    double share() const { return share_; }

    double at(const glm::dvec3& place) const {
        if (way_.lighting != CloudLighting::radiance) {
            const double depth = depth_.at(place);
            return way_.single ? phase_ * std::exp(-depth)
                               : sun_scattering(octaves_, offset_, depth);
        }
        const double depth = textures_.depth->at(place);
        const double first = phase_ / share_ * std::exp(-share_ * depth) * small_angles(depth);
        return first + SunDepth::sum_of_parts(textures_, values_, place);
    }

  private:
    double small_angles(double depth) const {
        return textures_.small_angles->at({forward_scattering::angle_coordinate_of_offset(offset_),
                                           forward_scattering::depth_coordinate(depth), 0.5});
    }

    const CloudWay& way_;
    const CloudTextures& textures_;
    SunDepth depth_;
    double offset_;  // 1 - cosine of the scattering angle
    CloudPhase cloud_phase_;
    std::array<OctavePhase, kOctaves> octaves_;
    double phase_;
    Harmonics values_;
    double share_ = 1;
};

}  // namespace

StoredTexture::StoredTexture(const Baked& baked) {
    const Level& level = baked.levels.front();
    size_ = level.size;
    is_table_ = baked.is_table();
    channels_.assign(baked.channel_names.size(),
                     std::vector<float>(occupancy::count_of(level.size)));
    std::vector<float*> out;
    for (std::vector<float>& channel : channels_) out.push_back(channel.data());
    level.voxels->fill({{}, level.size}, out);
    for (std::vector<float>& channel : channels_) {
        round_values(channel.data(), channel.size(), baked.pixel_type);
    }
}

double StoredTexture::sum_at(const glm::dvec3& place, const double* factors) const {
    std::array<double, 3> uvw = {place.x, place.y, place.z};
    if (is_table_) {
        for (std::size_t a = 0; a < 2; ++a) {
            uvw[a] =
                texture_coordinate(TexelConvention::end_points_on_texel_centres, uvw[a], size_[a]);
        }
    }
    double sum = 0;
    const std::array<bool, 3> repeats = {!is_table_, !is_table_, false};
    for (const VoxelTap& tap : trilinear_taps(size_, uvw, repeats)) {
        const std::size_t at = occupancy::index_of(size_, tap.voxel[0], tap.voxel[1], tap.voxel[2]);
        double texel = 0;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            texel += factors[c] * double{channels_[c][at]};
        }
        sum += tap.weight * texel;
    }
    return sum;
}

double stride_m(const CloudWay& way, const CloudLayer& layer) {
    return way.stride * *std::ranges::min_element(layer.voxel_m);
}

MarchedRay march_cloud(const CloudWay& way, const CloudTextures& textures, const glm::dvec3& place,
                       const glm::dvec3& look, const glm::dvec3& sun) {
    const CloudLayer& layer = *textures.layer;
    const SampleLight light(way, textures, look, sun);
    const double step_m = stride_m(way, layer);
    const double whole_m = distance_to_face(layer, place, look);
    const glm::dvec3 per_meter = look / extent_m(layer);
    MarchedRay ray;
    for (double at_m = 0.5 * step_m; at_m < whole_m && ray.passed > kLeastSeen; at_m += step_m) {
        ray.length_m = at_m;
        const glm::dvec3 sample = place + per_meter * at_m;
        const double depth = light.share() * extinction_at_share(layer, sample) * step_m;
        if (depth == 0) continue;
        ++ray.lit;
        ray.radiance += kAlbedo * ray.passed * -std::expm1(-depth) * light.at(sample);
        ray.passed *= std::exp(-depth);
    }
    return ray;
}

CloudFetches::CloudFetches(const CloudLayer& layer, double stride_m, const Baked* cells, int cell)
    : layer_(layer), stride_m_(stride_m), cell_(cell) {
    if (cell == 0) return;
    const Level& level = cells->levels.front();
    std::vector<float> shares(occupancy::count_of(level.size));
    level.voxels->fill({{}, level.size}, {shares.data()});
    for (const float share : shares) {
        leaps_.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
    }
}

occupancy::MarchFetches CloudFetches::along(const glm::dvec3& place, const glm::dvec3& look,
                                            double length_m) const {
    occupancy::SampledRay ray;
    for (glm::length_t a = 0; a < 3; ++a) {
        const auto i = static_cast<std::size_t>(a);
        ray.step[i] = look[a] * stride_m_ / layer_.voxel_m[i];
        ray.from[i] = place[a] * layer_.size[i] + ray.step[i] / 2;
    }
    ray.samples = static_cast<int>(std::floor(length_m / stride_m_)) + 1;
    if (cell_ == 0) return {ray.samples, 0};
    const occupancy::LeapCells cells{{layer_.size, cell_}, leaps_};
    const auto look_up = [&](const occupancy::Place& at) {
        return cloud_light::extinction_at(layer_, {at[0], at[1], at[2]}) > 0;
    };
    return occupancy::march(ray, cells, look_up);
}

}  // namespace skybake
