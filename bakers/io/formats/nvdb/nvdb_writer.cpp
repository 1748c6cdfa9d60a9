#include "bakers/io/formats/nvdb/nvdb_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/take_boxes.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/nvdb/nvdb_input.h"
#include "bakers/io/formats/nvdb/nvdb_layout.h"
#include "bakers/io/formats/nvdb/nvdb_leaves.h"
#include "bakers/io/formats/vdb/vdb_file.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Zeroed memory for a record of the library, whose constructors are deleted.
template <class T>
class NvdbRecord {
  public:
    explicit NvdbRecord(std::size_t bytes = sizeof(T))
        : memory_(nvdb_aligned(bytes) / sizeof(NvdbUnit)), bytes_(bytes) {}
    T& operator*() { return *reinterpret_cast<T*>(memory_.data()); }
    T* operator->() { return &**this; }
    char* data() { return reinterpret_cast<char*>(memory_.data()); }
    std::string_view bytes() { return {data(), bytes_}; }

  private:
    std::vector<NvdbUnit> memory_;
    std::size_t bytes_;
};

nanovdb::CoordBBox nvdb_bounds(const NvdbActive& active) {
    if (active.count == 0) return {};
    return {{active.first[0], active.first[1], active.first[2]},
            {active.last[0], active.last[1], active.last[2]}};
}

// An upper node that has children: lower nodes first ... first + count - 1 of those that have leaves.
struct NvdbUpperNode {
    std::array<int, 3> corner{};
    std::size_t first = 0;
    std::size_t count = 0;
    NvdbActive active;
};

// Writes one grid from the output's position on.
constexpr std::size_t leaf_bytes = sizeof(NvdbLeaf<float>);

class NvdbGridWriter {
  public:
    NvdbGridWriter(const FileContent& content, std::size_t channel,
                   const std::vector<VoxelBox>& nodes, FileOutput& output)
        : content_(content),
          volume_(content.baked),
          level_(volume_.levels[static_cast<std::size_t>(content.level)]),
          channel_(channel),
          nodes_(nodes),
          output_(output),
          begin_(output.position()) {
        // Nodes that turn out empty are left out, and their room stays free before the leaves.
        const auto uppers = cells_in_tree_order({{}, level_.size}, nvdb_upper_edge).size();
        leaves_at_ = nvdb_tiles_at + uppers * (sizeof(NvdbRoot::Tile) + sizeof(NvdbUpper)) +
                     nodes.size() * sizeof(NvdbLower);
    }

    // Returns false once progress->cancelled().
    bool write(const std::string& name, std::string_view description) {
        output_.seek(begin_ + leaves_at_);
        if (!write_leaves()) return false;
        collect_nodes();
        const std::uint64_t blind_at = leaves_at_ + leaves_ * leaf_bytes;
        std::uint64_t end = blind_at;
        if (!description.empty()) end += write_blind(description);
        write_uppers();
        for (std::size_t i = 0; i < made_.size(); ++i) write_lower(i);
        checksums_.insert(checksums_.end(), leaf_checksums_.begin(), leaf_checksums_.end());
        write_head(name, description.empty() ? 0 : blind_at, end);
        output_.seek(begin_ + end);
        return true;
    }

    const NvdbGridHead& head() const { return head_; }

  private:
    bool write_leaves() {
        const auto count = static_cast<int>(nodes_.size());
        lower_.resize(nodes_.size());
        return write_boxes<NvdbSlot>(
            count, content_.threads, content_.progress,
            [&](int i, NvdbSlot& made) {
                make_nvdb_leaves(volume_, level_, channel_, nodes_[static_cast<std::size_t>(i)],
                                 made);
            },
            [&](int i, NvdbSlot& made) {
                output_.write(made.leaves);
                for (std::size_t at = 0; at < made.leaves.size(); at += leaf_bytes) {
                    leaf_checksums_.push_back(nvdb_crc(made.leaves.substr(at, leaf_bytes)));
                }
                made.node.first_leaf = leaves_;
                leaves_ += made.node.leaves;
                lower_[static_cast<std::size_t>(i)] = made.node;
                return output_.error() == 0;
            });
    }

    // Lists the lower nodes that have leaves, and the upper nodes above them.
    void collect_nodes() {
        for (std::size_t i = 0; i < lower_.size(); ++i) {
            if (lower_[i].leaves == 0) continue;
            const std::array<int, 3> corner = node_corner(nodes_[i], nvdb_upper_edge);
            if (uppers_.empty() || uppers_.back().corner != corner) {
                uppers_.push_back({corner, made_.size(), 0, {}});
            }
            made_.push_back(i);
            ++uppers_.back().count;
            uppers_.back().active.add(lower_[i].active);
            whole_.add(lower_[i].active);
        }
        uppers_at_ = nvdb_tiles_at + uppers_.size() * sizeof(NvdbRoot::Tile);
        lowers_at_ = uppers_at_ + uppers_.size() * sizeof(NvdbUpper);
    }

    // Returns the number of bytes written.
    std::uint64_t write_blind(std::string_view description) {
        NvdbRecord<nanovdb::GridBlindMetaData> blind;
        blind->mByteOffset = sizeof(nanovdb::GridBlindMetaData);
        blind->mElementCount = description.size();
        std::strncpy(blind->mName, metadata_name, sizeof blind->mName - 1);
        const std::uint64_t bytes = nvdb_aligned(description.size());
        output_.write(blind.bytes());
        output_.write(description);
        output_.write(std::string(bytes - description.size(), '\0'));
        return sizeof(nanovdb::GridBlindMetaData) + bytes;
    }

    template <class Node>
    static void store_summary(const NvdbActive& active, Node& node) {
        node.mBBox = nvdb_bounds(active);
        node.mMinimum = active.count > 0 ? active.least : 0;
        node.mMaximum = active.count > 0 ? active.largest : 0;
    }

    void store_map(nanovdb::GridData& grid) {
        std::array<double, 3> edge;
        for (std::size_t a = 0; a < 3; ++a) {
            // A coarser level has fewer voxels in the same space.
            edge[a] = volume_.voxel_size_m[a] * volume_.levels.front().size[a] / level_.size[a];
            const double centre = volume_.minimum_m[a] + edge[a] / 2;
            nanovdb::Map& map = grid.mMap;
            map.mMatD[4 * a] = edge[a];
            map.mInvMatD[4 * a] = 1 / edge[a];
            map.mVecD[a] = centre;
            map.mMatF[4 * a] = static_cast<float>(edge[a]);
            map.mInvMatF[4 * a] = static_cast<float>(1 / edge[a]);
            map.mVecF[a] = static_cast<float>(centre);
            const auto axis = static_cast<int>(a);
            grid.mVoxelSize[axis] = edge[a];
            // The library counts the last voxel in: its bounds end one voxel after its centre.
            grid.mWorldBBox[0][axis] = centre + edge[a] * whole_.first[a];
            grid.mWorldBBox[1][axis] = centre + edge[a] * (whole_.last[a] + 1);
        }
        grid.mMap.mTaperF = 1;
        grid.mMap.mTaperD = 1;
        if (whole_.count == 0) grid.mWorldBBox = {};
        head_.voxel_size = edge;
    }

    // Writes grid, tree, root and tiles.
    void write_head(const std::string& name, std::uint64_t blind_at, std::uint64_t end) {
        NvdbRecord<nanovdb::GridData> grid(uppers_at_);
        fill_grid(*grid, name, blind_at, end);
        auto& tree = *reinterpret_cast<nanovdb::TreeData<3>*>(grid.data() + nvdb_tree_at);
        fill_tree(tree);
        auto* root = reinterpret_cast<NvdbRoot*>(grid.data() + nvdb_root_at);
        store_summary(whole_, *root);
        root->mTableSize = static_cast<std::uint32_t>(uppers_.size());
        for (std::size_t i = 0; i < uppers_.size(); ++i) {
            NvdbRoot::Tile& tile = *root->tile(static_cast<std::uint32_t>(i));
            const std::array<int, 3>& at = uppers_[i].corner;
            tile.key = NvdbRoot::CoordToKey(nanovdb::Coord(at[0], at[1], at[2]));
            tile.child =
                static_cast<std::int64_t>(uppers_at_ + i * sizeof(NvdbUpper) - nvdb_root_at);
        }
        grid->mChecksum = std::uint64_t{nvdb_crc_of_nodes(checksums_)} << 32 |
                          nvdb_crc(grid.bytes().substr(nvdb_summed_from));
        output_.seek(begin_);
        output_.write(grid.bytes());
        fill_file_head(*grid, tree, name);
    }

    void fill_grid(nanovdb::GridData& grid, const std::string& name, std::uint64_t blind_at,
                   std::uint64_t end) {
        grid.mMagic = NANOVDB_MAGIC_NUMBER;
        grid.mVersion = nanovdb::Version();
        grid.setMinMaxOn();
        grid.setBBoxOn(whole_.count > 0);
        grid.setBreadthFirstOn();
        grid.mGridCount = 1;
        grid.mGridSize = end;
        std::strncpy(grid.mGridName, name.c_str(), sizeof grid.mGridName - 1);
        store_map(grid);
        grid.mGridClass = nanovdb::GridClass::FogVolume;
        grid.mGridType = nanovdb::GridType::Float;
        grid.mBlindMetadataOffset = static_cast<std::int64_t>(blind_at);
        grid.mBlindMetadataCount = blind_at > 0 ? 1 : 0;
    }

    void fill_tree(nanovdb::TreeData<3>& tree) const {
        const auto offset = [](std::uint64_t at, std::size_t count) {
            return count > 0 ? at - nvdb_tree_at : 0;
        };
        tree.mNodeOffset[0] = offset(leaves_at_, leaves_);
        tree.mNodeOffset[1] = offset(lowers_at_, made_.size());
        tree.mNodeOffset[2] = offset(uppers_at_, uppers_.size());
        tree.mNodeOffset[3] = offset(nvdb_root_at, 1);
        tree.mNodeCount[0] = static_cast<std::uint32_t>(leaves_);
        tree.mNodeCount[1] = static_cast<std::uint32_t>(made_.size());
        tree.mNodeCount[2] = static_cast<std::uint32_t>(uppers_.size());
        tree.mVoxelCount = static_cast<std::uint64_t>(whole_.count);
    }

    void fill_file_head(const nanovdb::GridData& grid, const nanovdb::TreeData<3>& tree,
                        const std::string& name) {
        head_.grid_size = head_.file_size = grid.mGridSize;
        for (const char c : name) {  // the library's stringHash
            const std::uint64_t overflow = head_.name_key >> 56;
            head_.name_key = head_.name_key * 67 + static_cast<unsigned char>(c) + overflow;
        }
        head_.active_voxels = tree.mVoxelCount;
        head_.type = grid.mGridType;
        head_.world_bounds = grid.mWorldBBox;
        head_.bounds = nvdb_bounds(whole_);
        head_.name_size = static_cast<std::uint32_t>(name.size() + 1);
        std::copy_n(tree.mNodeCount, 3, head_.nodes.begin());
    }

    void write_uppers() {
        output_.seek(begin_ + uppers_at_);
        for (std::size_t i = 0; i < uppers_.size(); ++i) {
            const NvdbUpperNode& made = uppers_[i];
            NvdbRecord<NvdbUpper> node;
            store_summary(made.active, *node);
            for (std::size_t k = made.first; k < made.first + made.count; ++k) {
                const std::uint32_t child = child_place(nodes_[made_[k]].origin, nvdb_lower_edge,
                                                        nvdb_upper_edge / nvdb_lower_edge);
                node->mChildMask.setOn(child);
                node->mTable[child].child =
                    static_cast<std::int64_t>(lowers_at_ + k * sizeof(NvdbLower)) -
                    static_cast<std::int64_t>(uppers_at_ + i * sizeof(NvdbUpper));
            }
            write_node(node.bytes());
        }
    }

    void write_lower(std::size_t index) {
        const NvdbLowerNode& made = lower_[made_[index]];
        NvdbRecord<NvdbLower> node;
        store_summary(made.active, *node);
        static_assert(sizeof node->mChildMask == sizeof made.children);
        std::memcpy(static_cast<void*>(&node->mChildMask), made.children.data(),
                    sizeof made.children);
        std::uint64_t leaf =
            leaves_at_ + made.first_leaf * leaf_bytes - (lowers_at_ + index * sizeof(NvdbLower));
        for (std::uint32_t word = 0; word < made.children.size(); ++word) {
            for (std::uint64_t left = made.children[word]; left != 0; left &= left - 1) {
                const auto bit = static_cast<std::uint32_t>(std::countr_zero(left));
                node->mTable[64 * word + bit].child = static_cast<std::int64_t>(leaf);
                leaf += leaf_bytes;
            }
        }
        write_node(node.bytes());
    }

    void write_node(std::string_view bytes) {
        checksums_.push_back(nvdb_crc(bytes));
        output_.write(bytes);
    }

    const FileContent& content_;
    const Baked& volume_;
    const Level& level_;
    const std::size_t channel_;
    const std::vector<VoxelBox>&
        nodes_;  // lower ones that may have leaves, in the order of the file
    FileOutput& output_;
    const std::uint64_t begin_;
    std::uint64_t leaves_at_ = 0;  // offsets count from the grid's beginning
    std::uint64_t uppers_at_ = 0;
    std::uint64_t lowers_at_ = 0;
    std::uint64_t leaves_ = 0;
    std::vector<NvdbLowerNode> lower_;  // all of `nodes_`
    std::vector<std::size_t> made_;     // the nodes that have leaves
    std::vector<NvdbUpperNode> uppers_;
    std::vector<std::uint32_t> checksums_;  // of upper nodes, then of lower ones, then of leaves
    std::vector<std::uint32_t> leaf_checksums_;
    NvdbActive whole_;
    NvdbGridHead head_;
};

}  // namespace

Outcome<bool> write_nvdb(const FileContent& content, const fs::path& path) {
    const std::vector<std::string> names = vdb_grid_names(content.baked);
    std::uint64_t head_bytes = sizeof(NvdbSegment);
    for (const std::string& name : names) head_bytes += sizeof(NvdbGridHead) + name.size() + 1;
    const std::vector<VoxelBox> nodes =
        nodes_in_tree_order(content.baked.levels[static_cast<std::size_t>(content.level)].size);
    FileOutput output(path);
    output.seek(head_bytes);
    NvdbSegment segment;
    segment.grids = static_cast<std::uint16_t>(names.size());
    std::string head(reinterpret_cast<const char*>(&segment), sizeof segment);
    bool complete = true;
    for (std::size_t c = 0; complete && c < names.size(); ++c) {
        NvdbGridWriter grid(content, c, nodes, output);
        complete = grid.write(names[c], c == 0 ? content.metadata : "");
        head.append(reinterpret_cast<const char*>(&grid.head()), sizeof(NvdbGridHead));
        head.append(names[c].c_str(), names[c].size() + 1);
    }
    output.seek(0);
    output.write(head);
    return output.finished(complete);
}

}  // namespace skybake
