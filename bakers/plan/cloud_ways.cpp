#include "bakers/plan/cloud_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bakers/report/measurement.h"
#include "config/text/key_path.h"

namespace skybake {

using config::toml_string;

namespace {

// How densities are stored and marched.
struct Grade {
    int coarser = 1;  // the finest voxels' size over this
    std::string_view pixel_type;
    int stride = 1;
};
constexpr std::array<Grade, 7> kGrades = {{{1, "half", 1},
                                           {1, "unorm8", 1},
                                           {1, "unorm8", 2},
                                           {1, "bc4", 1},
                                           {2, "unorm8", 1},
                                           {2, "unorm8", 2},
                                           {4, "unorm8", 1}}};
constexpr std::array kCells = {0, 2, 4, 8};

// Lists the ways of one cloud.
class CloudWays {
  public:
    explicit CloudWays(const CloudSubject& subject) : subject_(subject) {}

    WayAsset density(int coarser, std::string_view pixel_type) const {
        std::array<int, 3> size = subject_.size;
        for (int& edge : size) edge = std::max(1, edge / coarser);
        WayAsset asset{subject_.cloud,
                       {{"asset", toml_string("cloud_volume")},
                        {"cloud", toml_string(subject_.cloud)},
                        {"size", fmt::format("[{}, {}, {}]", size[0], size[1], size[2])},
                        {"pixel_type", toml_string(pixel_type)},
                        {"formats", pixel_type == "float" ? "[\"exr\"]" : "[\"ktx2\"]"}}};
        if (!subject_.cover.empty()) asset.keys.emplace_back("cover", subject_.cover);
        return asset;
    }

    std::vector<CloudWay> all() {
        for (const Grade& grade : kGrades) {
            for (const int cell : kCells) {
                // Cells have to repeat as the voxels do.
                const auto tiles = [&](int edge) { return edge / grade.coarser % cell == 0; };
                if (cell > 0 && !(tiles(subject_.size[0]) && tiles(subject_.size[1]))) continue;
                start(grade, cell);
                add_marches();
                if (has_suns()) add_depths();
                if (grade.pixel_type != "unorm8") continue;
                if (grade.coarser > 1) add_harmonics();
                if (has_suns() && grade.coarser <= 2) add_radiance();
            }
        }
        return std::move(ways_);
    }

  private:
    bool has_suns() const { return !subject_.suns.empty() && subject_.suns.size() <= kMostLitSuns; }

    std::string name(std::string_view suffix) const {
        return fmt::format("{}_{}", subject_.cloud, suffix);
    }

    void start(const Grade& grade, int cell) {
        grade_ = grade;
        base_ = {};
        base_.stride = grade.stride;
        base_.cell = cell;
        base_.assets = {density(grade.coarser, grade.pixel_type)};
        base_.name =
            fmt::format("{}, {}", plain_value(base_.assets[0].keys[2].second), grade.pixel_type);
        if (grade.stride > 1) base_.name += fmt::format(", every {} voxels", grade.stride);
        if (cell == 0) return;
        base_.assets.push_back({name("cells"),
                                {{"asset", toml_string("occupancy")},
                                 {"of", toml_string(subject_.cloud)},
                                 {"cell", std::to_string(cell)},
                                 {"contents", "[\"leap\"]"},
                                 {"pixel_type", toml_string("unorm8")},
                                 {"formats", "[\"ktx2\"]"}}});
    }

    WayAsset light(std::string suffix, std::string_view contents, int cell) const {
        return {name(suffix),
                {{"asset", toml_string("cloud_light")},
                 {"of", toml_string(subject_.cloud)},
                 {"contents", toml_string(contents)},
                 {"cell", std::to_string(cell)},
                 {"formats", "[\"ktx2\"]"}}};
    }

    void push(CloudWay way, std::string_view by, std::string family, const std::string& what) {
        way.by = by;
        way.family = std::move(family);
        way.name += ", " + what;
        way.drawing = way.family + way.name;
        if (way.cell > 0) way.name += fmt::format(", leaps over cells of {}", way.cell);
        ways_.push_back(std::move(way));
    }

    void add_marches() {
        CloudWay way = base_;
        way.sun_samples = 16;
        way.single = true;
        way.baseline = "single scattering";
        push(way, "march", "single scattering", "16 samples to the sun");
        way.single = false;
        for (const int samples : {4, 8, 16}) {
            way.sun_samples = samples;
            way.baseline = samples == 4 ? "Wrenninge 2013, Hillaire 2016" : "";
            push(way, "march", "octaves, a march to the sun",
                 fmt::format("{} samples to the sun", samples));
        }
    }

    void add_depths() {
        for (const int cell : {2, 4, 8}) {
            CloudWay way = base_;
            way.lighting = CloudLighting::depth;
            way.first = way.assets.size();
            way.per_sun = 1;
            for (std::size_t sun = 0; sun < subject_.suns.size(); ++sun) {
                way.assets.push_back(
                    light(fmt::format("depth_{}", sun + 1), "optical_depth", cell));
                add_sun(way.assets.back(), sun);
            }
            push(way, "depth", "octaves, depths for each sun",
                 fmt::format("texels of {} voxels", cell));
        }
    }

    void add_sun(WayAsset& asset, std::size_t sun) const {
        asset.keys.emplace_back("sun_elevations", subject_.suns[sun]);
    }

    static void add_part(WayAsset& asset, int degree, int part) {
        asset.keys.emplace_back("degree", std::to_string(degree));
        asset.keys.emplace_back("part", std::to_string(part));
    }

    // Degree 2 and texels of finer voxels cost 20 times as much and are no nearer to the paths.
    void add_harmonics() {
        CloudWay way = base_;
        way.lighting = CloudLighting::harmonics;
        way.first = way.assets.size();
        way.assets.push_back(light("depths", "optical_depth_harmonics", 4));
        push(way, "harmonics", "octaves, depths for any sun", "harmonics of degree 1");
    }

    static int parts_of(int degree) { return ((degree + 1) * (degree + 1) + 3) / 4; }

    void add_radiance() {
        for (const int degree : {1, 3}) {
            CloudWay way = base_;
            way.lighting = CloudLighting::radiance;
            way.degree = degree;
            way.first = way.assets.size();
            way.assets.push_back({name("small_angles"),
                                  {{"asset", toml_string("forward_scattering")},
                                   {"degree", std::to_string(degree)},
                                   {"pixel_type", toml_string("half")},
                                   {"formats", "[\"ktx2\"]"}}});
            way.per_sun = 1 + static_cast<std::size_t>(parts_of(degree));
            // Texels of degree 3 of half the edge take a minute for 512x512x64 voxels.
            const int cell = grade_.coarser == 1 || degree == 3 ? 4 : 2;
            for (std::size_t sun = 0; sun < subject_.suns.size(); ++sun) {
                way.assets.push_back(
                    light(fmt::format("depth_{}", sun + 1), "optical_depth", cell));
                add_sun(way.assets.back(), sun);
                for (int part = 1; part <= parts_of(degree); ++part) {
                    way.assets.push_back(
                        light(fmt::format("radiance_{}_{}", sun + 1, part), "sun_radiance", cell));
                    add_sun(way.assets.back(), sun);
                    add_part(way.assets.back(), degree, part);
                }
            }
            push(way, "radiance", "radiance for each sun",
                 fmt::format("degree {}, texels of {} voxels", degree, cell));
        }
    }

    const CloudSubject& subject_;
    std::vector<CloudWay> ways_;
    Grade grade_;
    CloudWay base_;  // densities and cells, without light
};

}  // namespace

std::vector<CloudWay> cloud_ways(const CloudSubject& subject) { return CloudWays(subject).all(); }

Way traced_cloud(const CloudSubject& subject) {
    Way way;
    way.assets = {CloudWays(subject).density(1, "float")};
    return way;
}

}  // namespace skybake
