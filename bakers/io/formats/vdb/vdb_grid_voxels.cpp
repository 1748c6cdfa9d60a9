// Voxels of any program's VDB files, read leaf by leaf (vdb_source.h).
#include <fcntl.h>
#include <openvdb/io/Compression.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "bakers/io/files/system_call.h"
#include "bakers/io/formats/vdb/vdb_grid_tree.h"
#include "bakers/io/formats/vdb/vdb_input.h"
#include "bakers/io/formats/vdb/vdb_library.h"
#include "bakers/io/volumes/file_voxels.h"
#include "bakers/io/volumes/grid_voxels.h"

namespace skybake::vdb {
namespace {

namespace io = openvdb::io;
using Coord = openvdb::Coord;

Coord corner_of(const VoxelBox& box) { return {box.origin[0], box.origin[1], box.origin[2]}; }

template <class Value>
class GridVoxels : public VoxelSource {
  public:
    // Without `makes_densities`, values stay as the file has them.
    GridVoxels(const std::filesystem::path& path, const Grid& grid, GridTree tree, Input& input,
               bool makes_densities)
        : tree_(std::move(tree)),
          makes_densities_(makes_densities),
          half_(grid.descriptor.saveFloatAsHalf()),
          component_(grid.component),
          settings_(std::ios::binary),
          file_(uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); })) {
        expect(file_.valid(), "it has gone while it was read");
        settings_.copyfmt(input.stream());
        settings_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        io::setStreamMetadataPtr(settings_, metadata_, false);
        io::setDataCompression(settings_, grid.compression);
        io::setGridBackgroundValuePtr(settings_, tree_.stored_background.data());
    }

    // Decodes every leaf once, for the largest value of the grid and the faults.
    void survey(FileVoxels& voxels) {
        voxels.largest =
            std::max(tree_.density(tree_.least_tile), tree_.density(tree_.largest_tile));
        voxels.faults = tree_.faults;
        Decoder decoder(*this);
        for (LeafRecord& leaf : tree_.leaves) {
            leaf.is_zero = survey_leaf(leaf.corner, tree_.density, tree_.background,
                                       decoder.decode(leaf), voxels);
        }
        if (tree_.density.changes()) voxels.faults.negative = {};
    }

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        Decoder decoder(*this);
        for_cubes(box, vdb_leaf_edge, [&](const VoxelBox& part) {
            const GridTree::Place place = tree_.find(corner_of(part));
            if (place.leaf == nullptr || place.leaf->is_zero) {
                copy_leaf(
                    part, box, [&](auto) { return place.value; }, channels[0]);
            } else {
                LeafValues& values = decoder.decode(*place.leaf);
                if (makes_densities_) make_densities(tree_.density, tree_.background, values);
                copy_leaf(
                    part, box, [&](auto at) { return values[at]; }, channels[0]);
            }
            return true;
        });
    }

    bool is_empty(const VoxelBox& box) const override {
        return is_empty_by(box, vdb_upper_node_edge);
    }

  private:
    // Looks at cubes of an edge, and at smaller ones where a cube has children.
    bool is_empty_by(const VoxelBox& box, int edge) const {
        bool empty = true;
        for_cubes(box, edge, [&](const VoxelBox& part) {
            const GridTree::Place place = tree_.find(corner_of(part));
            if (place.edge < edge) {
                const int next = edge == vdb_upper_node_edge ? vdb_node_edge : vdb_leaf_edge;
                empty = is_empty_by(part, next);
            } else {
                empty = place.leaf != nullptr ? place.leaf->is_zero : place.value == 0;
            }
            return empty;
        });
        return empty;
    }

    // Reads leaves one after the other.
    class Decoder {
      public:
        explicit Decoder(const GridVoxels& voxels) : voxels_(voxels), in_(std::ios::binary) {
            in_.copyfmt(voxels.settings_);
        }

        // Returns the numbers as the file has them, rounded to float.
        LeafValues& decode(const LeafRecord& leaf) {
            bytes_.resize(leaf.bytes);
            voxels_.read(leaf.begin, bytes_);
            in_.clear();
            in_.str(bytes_);
            Leaf::NodeMaskType active;
            active.load(in_);
            // The file may have changed since its lengths were checked.
            const auto end = end_of_values(in_, leaf.bytes, Leaf::NUM_VALUES, active.countOn(),
                                           size_of_value<Value>(voxels_.half_));
            expect(end == leaf.bytes, "it has changed while it was read");
            io::readCompressedValues(in_, stored_.data(), Leaf::NUM_VALUES, active, voxels_.half_);
            std::transform(
                stored_.begin(), stored_.end(), values_.begin(),
                [&](const Value& value) { return number_of(value, voxels_.component_); });
            return values_;
        }

      private:
        const GridVoxels& voxels_;
        std::istringstream in_;
        std::string bytes_;
        std::array<Value, Leaf::NUM_VALUES> stored_{};
        LeafValues values_{};
    };

    void read(std::int64_t begin, std::string& bytes) const {
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t count = ::pread(file_.get(), bytes.data() + done, bytes.size() - done,
                                          static_cast<off_t>(begin) + static_cast<off_t>(done));
            if (count < 0 && errno == EINTR) continue;
            expect(count > 0, "it has changed while it was read");
            done += static_cast<std::size_t>(count);
        }
    }

    GridTree tree_;
    const bool makes_densities_;
    const bool half_;
    const int component_;
    io::StreamMetadata::Ptr metadata_{new io::StreamMetadata};
    std::istringstream settings_;  // of the streams that leaves are decoded from
    const FileDescriptor file_;
};

std::string name_of(const Grid& grid) {
    return io::GridDescriptor::nameAsString(grid.descriptor.uniqueName());
}

// Returns the grid of vectors with the component of that name: `v.x` of `v`.
std::optional<Grid> grid_of_component(const std::vector<Grid>& grids, const std::string& asked) {
    for (Grid grid : grids) {
        if (!is_of_vectors(grid)) continue;
        for (; grid.component < 3; ++grid.component) {
            if (asked == fmt::format("{}.{}", name_of(grid), "xyz"[grid.component])) return grid;
        }
    }
    return std::nullopt;
}

// Returns the grid of that name, or the grid of vectors with the component of that name. Without a name it
// is `density`, or the only grid of numbers.
Grid find_grid(const std::vector<Grid>& grids, const std::string& asked) {
    std::vector<GridName> names;
    for (const Grid& grid : grids) names.push_back({name_of(grid), is_of_numbers(grid)});
    std::size_t number = 0;
    const auto reason = find_grid_name(names, asked, number);
    const std::optional<Grid> found = reason ? grid_of_component(grids, asked) : grids[number];
    if (!found) throw Damaged(*reason);
    expect(!found->descriptor.isInstance(), "grids share a tree");
    if (!reason && is_of_vectors(*found)) {
        throw Damaged(
            fmt::format("its grid `{0}` holds vectors; write grid = \"{0}.x\", \"{0}.y\" or "
                        "\"{0}.z\"",
                        names[number].name));
    }
    return *found;
}

IndexAxes read_transform(const openvdb::GridBase& grid, FileVoxels& voxels) {
    expect(grid.transform().isLinear(), "its transform is not linear");
    const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
    IndexMap map;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            map.steps[i][j] = matrix[static_cast<int>(i)][static_cast<int>(j)];
        }
        map.centre[i] = matrix[3][static_cast<int>(i)];
    }
    IndexAxes axes;
    if (const auto reason = read_index_map(map, voxels, axes)) throw Damaged(*reason);
    return axes;
}

// Fills in the box of the voxels: what the grid's metadata says, else what is active.
void read_bounds(const openvdb::GridBase& grid, const GridTree& tree, VolumePart part,
                 FileVoxels& voxels) {
    constexpr std::int64_t most_voxels = std::numeric_limits<int>::max();
    const std::optional<Vector> stated = stated_vector(grid, vdb_size_name);
    const bool has_box = stated || !tree.active.empty();
    if (!has_box && part == VolumePart::numbers) return;
    expect(has_box, "it has no active voxels");
    const Vector first = stated ? Vector{} : tree.active.first;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t size = stated ? (*stated)[i] : tree.active.last[i] - first[i] + 1;
        expect(size > 0, "its size is damaged");
        expect(size <= most_voxels, "its active voxels lie too far apart");
        voxels.first[i] = static_cast<int>(first[i]);
        voxels.size[i] = static_cast<int>(size);
    }
}

}  // namespace

Outcome<FileVoxels> open_grid(const std::filesystem::path& path, const std::string& name,
                              VolumePart part, config::NotFinite not_finite) {
    return reported<FileVoxels>(path, [&] {
        Input input(path);
        openvdb::MetaMap metadata;
        input.read_metadata(metadata);
        const std::vector<Grid> grids = read_grid_heads(input);
        const Grid grid = find_grid(grids, name);
        FileVoxels voxels;
        voxels.has_place = true;
        with_number_type(grid, [&]<class Value>(Value) {
            const IndexAxes axes = read_transform(*grid.grid, voxels);
            GridTree tree = read_grid_tree(input, grid);
            const bool makes_densities = part != VolumePart::numbers;
            if (!makes_densities) tree.density = {};
            read_bounds(*grid.grid, tree, part, voxels);
            voxels.background = tree.density(tree.background);
            if (part != VolumePart::shape) {
                auto source = std::make_shared<GridVoxels<Value>>(path, grid, std::move(tree),
                                                                  input, makes_densities);
                if (makes_densities) source->survey(voxels);
                const bool refused =
                    not_finite == config::NotFinite::refuse && voxels.faults.not_finite.count > 0;
                if (refused) throw Damaged(refusal_of(voxels.faults));
                voxels.voxels = std::move(source);
            }
            turn_to_space(axes, voxels);
        });
        return voxels;
    });
}

}  // namespace skybake::vdb
