#include "bakers/io/formats/nvdb/nvdb_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "bakers/field/leaf_codes.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/nvdb/nvdb_layout.h"

namespace skybake {
namespace {

using config::Outcome;
namespace fs = std::filesystem;

constexpr std::uint16_t most_grids = 64;
constexpr std::uint32_t most_name = 4096;             // bytes
constexpr std::uint64_t most_description = 64 << 20;  // bytes

config::Diagnostic damaged_nvdb_file(const fs::path& path, const std::string& reason) {
    return file_error(
        "E0304", path.string(),
        fmt::format("`{}` is no NanoVDB file that skybake reads: {}", path.string(), reason));
}

// Thrown where a file is damaged_nvdb_file, with the reason; caught by the functions of the header.
struct NvdbDamage {
    std::string reason;
};

struct NvdbGrid {
    std::string name;
    NvdbGridHead head;
    std::uint64_t begin = 0;  // in the file
};

// A file that has been opened, with the heads of its grids.
class NvdbInput {
  public:
    explicit NvdbInput(FileInput file) : file_(std::move(file)) { read_heads(); }

    const std::vector<NvdbGrid>& grids() const { return grids_; }

    void read(std::uint64_t offset, void* bytes, std::size_t count) {
        const auto done = file_.read(offset, static_cast<char*>(bytes), count);
        if (!done || *done < count) throw NvdbDamage{"it ends early"};
    }
    template <class T>
    T read(std::uint64_t offset) {
        T value;
        read(offset, static_cast<void*>(&value), sizeof value);
        return value;
    }

    // Returns the text that the first grid carries, or "".
    std::string description() {
        const NvdbGrid& grid = grids_.front();
        const auto data = read<nanovdb::GridData>(grid.begin);
        if (data.mBlindMetadataCount == 0) return "";
        const auto at = static_cast<std::uint64_t>(data.mBlindMetadataOffset);
        if (at > grid.head.grid_size) throw NvdbDamage{"its description lies beyond its grid"};
        const auto blind = read<nanovdb::GridBlindMetaData>(grid.begin + at);
        if (std::strncmp(blind.mName, metadata_name, sizeof blind.mName) != 0) return "";
        const auto text_at = static_cast<std::uint64_t>(blind.mByteOffset);
        if (blind.mElementCount > std::min(most_description, grid.head.grid_size) ||
            text_at > grid.head.grid_size) {
            throw NvdbDamage{"its description lies beyond its grid"};
        }
        std::string text(blind.mElementCount, '\0');
        read(grid.begin + at + text_at, text.data(), text.size());
        return text;
    }

  private:
    void read_heads() {
        const auto segment = read<NvdbSegment>(0);
        if (segment.magic != NANOVDB_MAGIC_NUMBER) {
            throw NvdbDamage{"it does not begin with `NanoVDB0`"};
        }
        if (segment.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER) {
            throw NvdbDamage{fmt::format("its version is {}.{}", segment.version.getMajor(),
                                         segment.version.getMinor())};
        }
        if (segment.codec != 0) throw NvdbDamage{"it is compressed"};
        if (segment.grids == 0 || segment.grids > most_grids) {
            throw NvdbDamage{fmt::format("it has {} grids", segment.grids)};
        }
        std::uint64_t offset = sizeof segment;
        for (int i = 0; i < segment.grids; ++i) offset = read_head(offset);
        for (NvdbGrid& grid : grids_) {
            grid.begin = offset;
            if (grid.head.grid_size > file_.size() - offset)
                throw NvdbDamage{"it ends within a grid"};
            offset += grid.head.grid_size;
        }
        if (offset != file_.size()) throw NvdbDamage{"there is more behind its grids"};
    }

    // Returns the offset behind it.
    std::uint64_t read_head(std::uint64_t offset) {
        NvdbGrid grid;
        read(offset, static_cast<void*>(&grid.head), sizeof grid.head);
        if (nvdb_leaf_bytes(grid.head.type) == 0) {
            throw NvdbDamage{fmt::format("its grids are of type {}",
                                         static_cast<std::uint32_t>(grid.head.type))};
        }
        if (grid.head.name_size == 0 || grid.head.name_size > most_name) {
            throw NvdbDamage{"a grid has no name"};
        }
        grid.name.resize(grid.head.name_size - 1);
        offset += sizeof grid.head;
        read(offset, grid.name.data(), grid.name.size());
        offset += grid.head.name_size;
        if (offset > file_.size()) throw NvdbDamage{"it ends early"};
        grids_.push_back(std::move(grid));
        return offset;
    }

    FileInput file_;
    std::vector<NvdbGrid> grids_;
};

// Where the leaves of a grid are.
class NvdbLeafIndex {
  public:
    NvdbLeafIndex(NvdbInput& file, const NvdbGrid& grid, const std::array<int, 3>& size)
        : file_(file), grid_(grid), leaf_bytes_(nvdb_leaf_bytes(grid.head.type)) {
        for (std::size_t a = 0; a < 3; ++a) count_[a] = (size[a] - 1) / nvdb_leaf_edge + 1;
        offsets_.resize(static_cast<std::size_t>(VoxelBox{{}, count_}.count()));
        read_tree();
    }

    // Returns the offset in the file of the leaf at a place in units of leaves, or 0.
    std::uint64_t operator()(int x, int y, int z) const { return offsets_[at({x, y, z})]; }
    const std::array<int, 3>& count() const { return count_; }

  private:
    std::size_t at(const std::array<int, 3>& place) const {
        return static_cast<std::size_t>(
            (std::int64_t{place[2]} * count_[1] + place[1]) * count_[0] + place[0]);
    }

    // Returns `from + step`, where a record of `bytes` bytes must lie in the grid.
    std::uint64_t checked(std::uint64_t from, std::int64_t step, std::uint64_t bytes) const {
        const std::uint64_t offset = from + static_cast<std::uint64_t>(step);
        if (offset < nvdb_root_at || offset > grid_.head.grid_size ||
            bytes > grid_.head.grid_size - offset) {
            throw NvdbDamage{"a node lies beyond its grid"};
        }
        return offset;
    }

    void read_tree() {
        const auto data = file_.read<nanovdb::GridData>(grid_.begin);
        if (data.mMagic != NANOVDB_MAGIC_NUMBER || data.mGridType != grid_.head.type ||
            data.mGridSize != grid_.head.grid_size) {
            throw NvdbDamage{"a grid contradicts its head"};
        }
        const auto tree = file_.read<nanovdb::TreeData<3>>(grid_.begin + nvdb_tree_at);
        const std::uint64_t root =
            checked(nvdb_tree_at, static_cast<std::int64_t>(tree.mNodeOffset[3]), sizeof(NvdbRoot));
        constexpr std::size_t bounds = 24;  // before the number of tiles
        const auto tiles = file_.read<std::uint32_t>(grid_.begin + root + bounds);
        checked(root, sizeof(NvdbRoot), std::uint64_t{tiles} * sizeof(NvdbRoot::Tile));
        if (tiles > most_nodes(nvdb_upper_edge)) throw NvdbDamage{"nodes are listed twice"};
        for (std::uint32_t i = 0; i < tiles; ++i) {
            const auto tile = file_.read<NvdbRoot::Tile>(grid_.begin + root + sizeof(NvdbRoot) +
                                                         i * sizeof(NvdbRoot::Tile));
            const nanovdb::Coord origin = tile.origin();
            read_upper(checked(root, tile.child, sizeof(NvdbUpper)),
                       {origin[0] / nvdb_leaf_edge, origin[1] / nvdb_leaf_edge,
                        origin[2] / nvdb_leaf_edge});
        }
    }

    // Calls `child` with the place in the node of each child, in units of children, and its offset.
    template <class Node, class Child>
    void for_children(std::uint64_t node, int log2_edge, const Child& child) {
        std::vector<char> memory(sizeof(Node));
        file_.read(grid_.begin + node, memory.data(), memory.size());
        const auto* data = reinterpret_cast<const Node*>(memory.data());
        for (std::uint32_t i = 0; i < 1U << 3 * log2_edge; ++i) {
            if (!data->mChildMask.isOn(i)) continue;
            const auto edge = static_cast<int>(i);
            const int mask = (1 << log2_edge) - 1;
            child(std::array<int, 3>{edge >> 2 * log2_edge, edge >> log2_edge & mask, edge & mask},
                  data->mTable[i].child);
        }
    }

    void read_upper(std::uint64_t node, const std::array<int, 3>& origin) {
        constexpr int step = nvdb_lower_edge / nvdb_leaf_edge;
        for_children<NvdbUpper>(node, 5, [&](const std::array<int, 3>& at, std::int64_t offset) {
            read_lower(
                checked(node, offset, sizeof(NvdbLower)),
                {origin[0] + step * at[0], origin[1] + step * at[1], origin[2] + step * at[2]});
        });
    }

    void read_lower(std::uint64_t node, const std::array<int, 3>& origin) {
        if (++lower_nodes_ > most_nodes(nvdb_lower_edge))
            throw NvdbDamage{"nodes are listed twice"};
        for_children<NvdbLower>(node, 4, [&](const std::array<int, 3>& at, std::int64_t offset) {
            std::array<int, 3> place;
            for (std::size_t a = 0; a < 3; ++a) {
                place[a] = origin[a] + at[a];
                if (place[a] < 0 || place[a] >= count_[a]) {
                    throw NvdbDamage{"a leaf lies beyond the volume"};
                }
            }
            offsets_[this->at(place)] = grid_.begin + checked(node, offset, leaf_bytes_);
        });
    }

    // Returns how many nodes of so many voxels along an edge the volume has at most.
    std::int64_t most_nodes(int edge) const {
        std::int64_t most = 1;
        for (const int count : count_) most *= (count - 1) / (edge / nvdb_leaf_edge) + 1;
        return most;
    }

    NvdbInput& file_;
    const NvdbGrid& grid_;
    const std::size_t leaf_bytes_;
    std::array<int, 3> count_{};  // of leaves
    std::vector<std::uint64_t> offsets_;
    std::int64_t lower_nodes_ = 0;
};

// Reads the 512 values of a leaf.
void read_nvdb_leaf(NvdbInput& file, nanovdb::GridType type, std::uint64_t offset,
                    std::vector<char>& memory, std::array<float, nvdb_leaf_voxels>& values) {
    memory.resize(nvdb_leaf_bytes(type));
    file.read(offset, memory.data(), memory.size());
    const auto decode = [&]<class Build>(Build) {
        const auto& leaf = *reinterpret_cast<const NvdbLeaf<Build>*>(memory.data());
        const LeafCodes scale{leaf.mMinimum, leaf.mQuantum};
        for (std::size_t i = 0; i < nvdb_leaf_voxels; ++i) values[i] = scale.value(leaf.mCode[i]);
    };
    if (type == nanovdb::GridType::Fp8) return decode(nanovdb::Fp8{});
    if (type == nanovdb::GridType::Fp16) return decode(nanovdb::Fp16{});
    std::memcpy(values.data(), reinterpret_cast<const NvdbLeaf<float>*>(memory.data())->mValues,
                sizeof values);
}

// Passes the voxels to `visit`, eight slices at a time. Returns false once it has returned false.
bool visit_nvdb_slabs(NvdbInput& file, const FileShape& shape, const VoxelVisitor& visit) {
    std::vector<NvdbLeafIndex> indices;
    for (const NvdbGrid& grid : file.grids()) indices.emplace_back(file, grid, shape.size);
    const std::int64_t slice = std::int64_t{shape.size[0]} * shape.size[1];
    std::vector<float> slab;
    std::vector<char> memory;
    std::array<float, nvdb_leaf_voxels> values;
    for (int z = 0; z < shape.size[2]; z += nvdb_leaf_edge) {
        const int depth = std::min(nvdb_leaf_edge, shape.size[2] - z);
        slab.assign(static_cast<std::size_t>(slice * depth) * shape.channels, 0.0F);
        for (std::size_t c = 0; c < indices.size(); ++c) {
            const std::array<int, 3>& count = indices[c].count();
            for (int leaf = 0; leaf < count[0] * count[1]; ++leaf) {
                const int x = leaf % count[0];
                const int y = leaf / count[0];
                const std::uint64_t offset = indices[c](x, y, z / nvdb_leaf_edge);
                if (offset == 0) continue;
                read_nvdb_leaf(file, file.grids()[c].head.type, offset, memory, values);
                for (int k = 0; k < depth; ++k) {
                    for (int j = 0;
                         j < std::min(nvdb_leaf_edge, shape.size[1] - y * nvdb_leaf_edge); ++j) {
                        const std::int64_t row =
                            k * slice + std::int64_t{y * nvdb_leaf_edge + j} * shape.size[0] +
                            x * nvdb_leaf_edge;
                        float* out = &slab[static_cast<std::size_t>(row) * shape.channels + c];
                        for (int i = 0;
                             i < std::min(nvdb_leaf_edge, shape.size[0] - x * nvdb_leaf_edge);
                             ++i, out += shape.channels) {
                            *out = values[static_cast<std::size_t>(64 * i + 8 * j + k)];
                        }
                    }
                }
            }
        }
        if (!visit(z * slice, depth * slice, slab.data())) return false;
    }
    return true;
}

template <class T, class Work>
Outcome<T> with_nvdb_file(const fs::path& path, const Work& work) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    try {
        NvdbInput opened(std::move(*file.value));
        return work(opened);
    } catch (const NvdbDamage& damage) {
        return {{}, {damaged_nvdb_file(path, damage.reason)}};
    }
}

}  // namespace

Outcome<FileFacts> inspect_nvdb(const fs::path& path) {
    return with_nvdb_file<FileFacts>(path, [&](NvdbInput& file) -> Outcome<FileFacts> {
        FileFacts facts;
        const nanovdb::GridType type = file.grids().front().head.type;
        for (const NvdbGrid& grid : file.grids()) {
            if (grid.head.type != type) throw NvdbDamage{"its grids are of different types"};
            facts.names.push_back(grid.name);
        }
        facts.channels = facts.names.size();
        if (type == nanovdb::GridType::Fp8) facts.pixel_type = config::PixelType::fp8;
        if (type == nanovdb::GridType::Fp16) facts.pixel_type = config::PixelType::fp16;
        facts.metadata = file.description();
        return {std::move(facts), {}};
    });
}

Outcome<bool> read_nvdb(const fs::path& path, const FileShape& shape, const VoxelVisitor& visit) {
    return with_nvdb_file<bool>(path, [&](NvdbInput& file) -> Outcome<bool> {
        for (const NvdbGrid& grid : file.grids()) {
            const bool fits = file.grids().size() == shape.channels &&
                              grid.head.type == nvdb_grid_type(shape.pixel_type);
            if (!fits) return {{}, {other_size(path)}};
        }
        return {visit_nvdb_slabs(file, shape, visit), {}};
    });
}

}  // namespace skybake
