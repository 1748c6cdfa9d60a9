#include "bakers/workspace/bake_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/temporary_file.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/journal.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/parallel.h"
#include "bakers/workspace/copy_asset.h"
#include "config/assets/asset_kind.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Whether a copy failed because of its source, not because of its target.
bool is_unusable(const std::vector<Diagnostic>& diagnostics) {
    return std::ranges::any_of(diagnostics, [](const Diagnostic& diagnostic) {
        return diagnostic.code == "E0300" || diagnostic.code == "E0304";
    });
}

// Whether the entry lists the files of this section and no others. The source may be wrong.
bool has_files_of(const Bake& bake, const ManifestAsset& entry) {
    std::vector<std::string> expected = file_names(bake);
    std::vector<std::string> found;
    for (const ManifestFile& file : entry.files) found.push_back(file.path);
    std::ranges::sort(expected);
    std::ranges::sort(found);
    return entry.name == bake.name && found == expected;
}

bool is_frame(const FolderBake& bake, const Bake& asset) {
    return config::frame_of(bake.recipe->parameters, asset) > 0;
}

// One bake into one locked folder. Each step returns whether to go on. If not, the diagnostics say
// why; after an interruption there are none.
class FolderMaker {
  public:
    // Voxels are held only in memory that the bake does not need otherwise.
    FolderMaker(const FolderBake& bake, const FolderPlan& plan, BakeObserver& observer)
        : bake_(bake),
          plan_(plan),
          observer_(observer),
          held_voxel_bytes_(
              bytes_to_keep(bake.held_voxel_bytes, bake.memory_limit_mib, plan.memory_mib())),
          own_intermediates_(held_voxel_bytes_, bake.kept),
          intermediates_(bake.intermediates ? *bake.intermediates : own_intermediates_),
          files_(LeftOvers::already_looked_for),
          journal_(bake.folder),
          prepared_(plan.assets.size()) {
        result_.retired = plan.retired;
        pruned_ = plan.pruned;
        for (const PlannedAsset& planned : plan.assets) {
            expected_.push_back(intermediates_.expect(planned.needs));
            FinishedAsset& finished = result_.assets.emplace_back();
            if (planned.stale()) continue;
            finished.state = AssetState::up_to_date;
            finished.entry = *planned.up_to_date;
            finished.files.assign(finished.entry.files.size(), WriteResult::unchanged);
        }
    }

    Outcome<BakedFolder> make() {
        const bool made = has_modules() && make_frames() && make_all() && stage_all() &&
                          stage_manifest() && commit(staged(), Told::by_staged_manifest);
        if (made) {
            journal_.end();
        } else if (!is_half_named_) {
            list_named();
        }
        if (!made || !offer_up_to_date() || !prune()) return {{}, std::move(diagnostics_)};
        std::erase_if(result_.assets,
                      [](const FinishedAsset& finished) { return finished.files.empty(); });
        return {std::move(result_), std::move(diagnostics_)};
    }

  private:
    bool stop(std::vector<Diagnostic> diagnostics) {
        for (Diagnostic& diagnostic : diagnostics) {
            // Diagnostics of what assets share are reported once.
            const bool is_said = std::ranges::any_of(diagnostics_, [&](const Diagnostic& said) {
                return said.code == diagnostic.code && said.message == diagnostic.message;
            });
            if (!is_said) diagnostics_.push_back(std::move(diagnostic));
        }
        return false;
    }

    bool has_modules() {
        for (const PlannedAsset& planned : plan_.assets) {
            if (!planned.stale()) continue;
            if (auto obstacle = missing_module(*planned.bake, bake_.folder)) {
                return stop({std::move(*obstacle)});
            }
        }
        return true;
    }

    bool is_made_by_frame(std::size_t i) const {
        return bake_.frame_by_frame && is_frame(bake_, *plan_.assets[i].bake);
    }

    // Makes the frames of a sequence one after the other, up to one that fails, and gives each its
    // names.
    bool make_frames() {
        for (const std::size_t i : unnamed()) {
            if (!is_made_by_frame(i)) continue;
            const bool made = make(i);
            if (observer_.cancelled()) return stop_for_interruption();
            if (!made) break;
            if (!stage(i) || !commit({i}, Told::by_journal)) return false;
        }
        return true;
    }

    // Makes all other assets. All are tried: one run shows all errors and makes all that can be made.
    bool make_all() {
        bool any = plan_.stale_count() == 0;
        for (const std::size_t i : unnamed()) {
            if (is_made_by_frame(i)) continue;
            any = make(i) || any;
            if (observer_.cancelled()) return stop_for_interruption();
        }
        return any || !named_.empty();
    }

    // Returns the stale assets whose files do not have their names yet.
    std::vector<std::size_t> unnamed() const {
        std::vector<std::size_t> assets;
        for (std::size_t i = 0; i < plan_.assets.size(); ++i) {
            if (plan_.assets[i].stale() && !named_.contains(i)) assets.push_back(i);
        }
        return assets;
    }

    // Returns those of them that were made.
    std::vector<std::size_t> staged() const {
        std::vector<std::size_t> assets = unnamed();
        std::erase_if(assets, [this](std::size_t i) { return result_.assets[i].files.empty(); });
        return assets;
    }

    // Copies a stale asset from a source or bakes it.
    bool make(std::size_t i) {
        const auto progress = observer_.begin(plan_.assets[i].bake->name);
        const bool good = copy(i, *progress) || bake(i, *progress);
        expected_[i] = {};
        return good;
    }

    // If the asset of a source cannot be read or is damaged, the asset is baked.
    bool copy(std::size_t i, const Progress& progress) {
        for (AssetSource* source : bake_.sources) {
            const auto ready = source->find(plan_.assets[i].identity.key);
            if (!ready || !has_files_of(*plan_.assets[i].bake, ready->entry)) continue;
            auto staged = source->stage(*ready, bake_.folder, files_, progress);
            if (!staged.value) {
                if (is_unusable(staged.diagnostics)) source->reject(*ready);
                continue;
            }
            result_.assets[i] = {AssetState::copied, ready->entry, std::move(*staged.value)};
            repeat_warnings(ready->entry, *plan_.assets[i].bake);
            return true;
        }
        return false;
    }

    void repeat_warnings(const ManifestAsset& entry, const Bake& bake) {
        std::vector<Diagnostic> warnings = entry.warnings;
        for (Diagnostic& warning : warnings) {
            warning.severity = config::Severity::warning;
            add_recipe_place(*bake_.recipe, bake, warning);
        }
        stop(std::move(warnings));
    }

    bool bake(std::size_t i, Progress& progress) {
        if (observer_.cancelled()) return false;
        const PlannedAsset& planned = plan_.assets[i];
        BakeOptions options;
        options.threads = bake_.threads;
        options.certification = bake_.certification;
        options.progress = &progress;
        options.held_voxel_bytes = held_voxel_bytes_;
        options.intermediates = &intermediates_;
        BakeClock clock;
        auto baked = bake_asset(*bake_.recipe, *planned.bake, options);
        const BakeSeconds seconds = clock.seconds();
        stop(baked.diagnostics);
        if (!baked.value) return false;
        if (auto changed = changed_input(planned)) return stop({std::move(*changed)});
        ManifestAsset entry = describe_with_files(*baked.value);
        entry.timing.bake = seconds;
        entry.timing.threads = thread_count(bake_.threads);
        entry.warnings = std::move(baked.diagnostics);
        for (Diagnostic& warning : entry.warnings) warning.where = {};
        sign(planned.identity, entry);
        prepared_[i] = PreparedAsset{std::move(*baked.value), std::move(entry)};
        return true;
    }

    // Returns a diagnostic if an input picture has changed since the asset's key was made.
    // Otherwise the asset would be stored under the wrong key.
    std::optional<Diagnostic> changed_input(const PlannedAsset& planned) const {
        const auto now = asset_identity(*bake_.recipe, *planned.bake, bake_.certification);
        if (!now.value) return now.diagnostics.front();
        if (now.value->key == planned.identity.key) return std::nullopt;
        return file_error(
            "E0300", "",
            fmt::format("a map of `bake.{}` changed while it was being baked; bake again",
                        planned.bake->name));
    }

    bool stage_all() {
        for (std::size_t i = 0; i < prepared_.size(); ++i) {
            if (!stage(i)) return false;
        }
        return true;
    }

    // Stages the files of an asset that was baked; those of a copied one are staged.
    bool stage(std::size_t i) {
        if (!prepared_[i]) return true;
        const auto progress = observer_.begin(plan_.assets[i].bake->name);
        auto& [baked, entry] = *prepared_[i];
        auto staged =
            stage_files(baked, entry, bake_.folder, files_, bake_.threads, progress.get());
        if (!staged.value) return stop(std::move(staged.diagnostics));
        if (staged.value->back() == WriteResult::interrupted) return stop_for_interruption();
        result_.assets[i] = {AssetState::baked, std::move(entry), std::move(*staged.value)};
        prepared_[i].reset();
        return true;
    }

    // The files of an entry that stays are none that the recipe has given up.
    void keep_files_of(const ManifestAsset& entry) {
        const auto is_its = [&entry](const RetiredFile& retired) {
            return std::ranges::any_of(entry.files,
                                       [&](const auto& file) { return file.path == retired.path; });
        };
        std::erase_if(result_.retired, is_its);
        std::erase_if(pruned_, is_its);
    }

    // Returns the entry of an asset that was made; its lookup is this release's.
    ManifestAsset entry_of(std::size_t i) const {
        ManifestAsset entry = result_.assets[i].entry;
        const Bake& bake = *plan_.assets[i].bake;
        const std::array<int, 3>& size = entry.levels[0].size;
        entry.lookup_cost = cost_of(baker_of(bake).lookup(
            bake_.recipe->parameters, bake,
            {entry.mapping, {size.begin(), size.end()}, entry.channels.size()}));
        return entry;
    }

    // Stages the manifest last, so that it gets its name last: whoever sees it sees its files.
    bool stage_manifest() {
        Manifest manifest = new_manifest(*bake_.recipe);
        for (std::size_t i = 0; i < result_.assets.size(); ++i) {
            const bool failed = result_.assets[i].files.empty();
            if (!failed) {
                manifest.assets.push_back(entry_of(i));
            } else if (const auto* before =
                           entry_before(plan_.folder, plan_.assets[i].bake->name)) {
                manifest.assets.push_back(*before);
                keep_files_of(*before);
            }
        }
        const bool partial = bake_.bakes.size() < bake_.recipe->parameters.bakes.size();
        if (partial && plan_.folder.previous) {
            manifest = merge_manifests(*plan_.folder.previous, std::move(manifest));
            warn_of_other_values();
        }
        manifest.retired = result_.retired;
        manifest_ = std::move(manifest);
        const auto progress = observer_.begin(manifest_name);
        const std::string text = manifest_json(manifest_);
        const auto staged =
            files_.stage(bake_.folder / manifest_name, std::string_view(text), progress.get());
        if (!staged.value) return stop(staged.diagnostics);
        result_.manifest = *staged.value;
        return result_.manifest != WriteResult::interrupted || stop_for_interruption();
    }

    // Removes retired files after all new files have their names. The manifest lists a file until
    // it is removed, so that a later bake knows it even if this one is killed. A file that was
    // changed in the meantime is kept.
    bool prune() {
        std::vector<Diagnostic> failures;
        for (const RetiredFile& file : pruned_) {
            if (!is_as_written(bake_.folder, file)) continue;
            std::error_code error;
            if (fs::remove(bake_.folder / file.path, error)) {
                result_.pruned.push_back(file);
                std::erase_if(result_.retired, [&file](const RetiredFile& other) {
                    return other.path == file.path;
                });
            } else if (error) {
                const std::string path = (bake_.folder / file.path).string();
                failures.push_back(file_error(
                    "E0301", path, fmt::format("cannot remove `{}`: {}", path, error.message())));
            }
        }
        if (!result_.pruned.empty()) {
            manifest_.retired = result_.retired;
            auto written =
                write_file_atomically(bake_.folder / manifest_name, manifest_json(manifest_));
            failures.insert(failures.end(), written.diagnostics.begin(), written.diagnostics.end());
        }
        return failures.empty() || stop(std::move(failures));
    }

    // Warns if assets that are not baked now have other values than the recipe's current ones,
    // which the manifest states.
    void warn_of_other_values() {
        for (const Bake& section : bake_.recipe->parameters.bakes) {
            const auto is_this = [&section](const auto& other) {
                return other.name == section.name;
            };
            if (std::ranges::any_of(bake_.bakes, is_this)) continue;
            const ManifestAsset* entry = entry_before(plan_.folder, section.name);
            if (entry == nullptr) continue;
            const auto identity = asset_identity(*bake_.recipe, section, bake_.certification);
            if (!identity.value) continue;
            const auto reasons = differences(*identity.value, *entry);
            if (reasons.empty()) continue;
            diagnostics_.push_back(
                diagnosis("W0303", fmt::format("`bake.{}` was kept, although it is out of date: {}",
                                               section.name, fmt::join(reasons, "; "))));
        }
    }

    // How the next bake would know of files if this one were killed while they get their names: a
    // staged manifest is a journal until it has its own.
    enum class Told { by_journal, by_staged_manifest };

    // Gives the staged files their names.
    bool commit(const std::vector<std::size_t>& assets, Told told) {
        std::vector<ManifestAsset> entries;
        for (const std::size_t i : assets) entries.push_back(result_.assets[i].entry);
        std::vector<Diagnostic> failures;
        if (told == Told::by_journal) failures = journal_.add(entries);
        const std::size_t before = files_.size();
        if (failures.empty()) failures = files_.commit();
        if (!failures.empty()) {
            is_half_named_ = files_.size() < before;
            // The staged manifest will be gone.
            if (is_half_named_ && told == Told::by_staged_manifest) stop(journal_.add(entries));
            return stop(std::move(failures));
        }
        named_.insert(assets.begin(), assets.end());
        for (const ManifestAsset& entry : entries) offer(entry);
        return true;
    }

    void offer(const ManifestAsset& entry) {
        for (AssetSource* source : bake_.sources) source->offer({bake_.folder, entry});
    }

    bool offer_up_to_date() {
        for (const FinishedAsset& finished : result_.assets) {
            const bool is_made = !finished.files.empty();
            if (is_made && finished.state == AssetState::up_to_date) offer(finished.entry);
        }
        return true;
    }

    // Writes a manifest of what has got its names before an interruption or an error.
    void list_named() {
        if (named_.empty()) return journal_.discard();
        Manifest manifest = new_manifest(*bake_.recipe);
        for (const std::size_t i : named_) manifest.assets.push_back(entry_of(i));
        if (plan_.folder.previous) {
            const Manifest& previous = *plan_.folder.previous;
            manifest = merge_manifests(previous, std::move(manifest));
            manifest.retired = files_no_longer_made(previous, manifest);
        }
        files_.shrink(0);
        const std::string text = manifest_json(manifest);
        auto failures =
            files_.stage(bake_.folder / manifest_name, std::string_view(text)).diagnostics;
        if (failures.empty()) failures = files_.commit();
        if (failures.empty()) return journal_.end();
        if (!diagnostics_.empty()) stop(std::move(failures));
    }

    // Drops the diagnostics found so far, because the user does not want to read them after
    // interrupting.
    bool stop_for_interruption() {
        diagnostics_.clear();
        return false;
    }

    const FolderBake& bake_;
    const FolderPlan& plan_;
    BakeObserver& observer_;
    const std::int64_t held_voxel_bytes_;
    Intermediates own_intermediates_;
    Intermediates& intermediates_;
    std::vector<Intermediates::Expected> expected_;  // of each asset, until it is made
    BakedFolder result_;
    std::vector<RetiredFile> pruned_;  // to be removed
    Manifest manifest_;
    AtomicFiles files_;
    BakeJournal journal_;
    std::set<std::size_t> named_;  // assets whose files have their names
    bool is_half_named_ = false;   // a commit failed, and the journal alone knows where
    // An asset whose bake has succeeded, and its entry in the manifest. Nothing has been written to
    // the disk yet.
    struct PreparedAsset {
        Baked baked;
        ManifestAsset entry;
    };
    std::vector<std::optional<PreparedAsset>> prepared_;  // none: up to date, or copied
    std::vector<Diagnostic> diagnostics_;
};

// Folders that this process has made, and removes again if nothing comes into them.
class MadeFolders {
  public:
    explicit MadeFolders(std::vector<fs::path> folders) : folders_(std::move(folders)) {}
    MadeFolders(MadeFolders&& other) noexcept : folders_(std::exchange(other.folders_, {})) {}
    ~MadeFolders() { remove_empty_folders(folders_); }

  private:
    std::vector<fs::path> folders_;
};

struct LockedFolder {
    FolderLock lock;
    MadeFolders made;  // the last member: removed while the lock is held
};

// Makes and locks the folder, repeatedly if necessary: another process may remove the folder that
// it made while this one waits for it.
Outcome<LockedFolder> lock_folder(const fs::path& folder, BakeObserver& observer) {
    bool told = false;
    const auto waits = [&] {
        if (!told) observer.waits();
        told = true;
    };
    while (true) {
        auto made = create_output_folder(folder);
        if (!made.value) return {{}, std::move(made.diagnostics)};
        auto lock = FolderLock::acquire(folder, waits, [&] { return observer.cancelled(); });
        if (lock.value) {
            return {LockedFolder{std::move(*lock.value), MadeFolders(std::move(*made.value))}, {}};
        }
        std::error_code error;
        if (lock.diagnostics.empty() || fs::exists(folder, error)) {
            return {{}, std::move(lock.diagnostics)};
        }
    }
}

}  // namespace

std::optional<Diagnostic> missing_module(const Bake& bake, const fs::path& folder) {
    const config::AssetFiles& files = config::files_of(bake);
    for (const config::FileFormat format : files.formats) {
        const auto ask = format_of(format).obstacle;
        if (ask == nullptr) continue;
        if (auto obstacle = ask(folder / file_name(bake.name, files, format, 0))) return obstacle;
    }
    return std::nullopt;
}

bool has_frames(const FolderBake& bake) {
    return bake.frame_by_frame && std::ranges::any_of(bake.bakes, [&](const Bake& asset) {
               return is_frame(bake, asset);
           });
}

Outcome<BakedFolder> bake_folder(const FolderBake& bake, BakeObserver& observer) {
    auto locked = lock_folder(bake.folder, observer);
    if (!locked.value) return {{}, std::move(locked.diagnostics)};
    auto plan = plan_folder(bake);
    Outcome<BakedFolder> outcome;
    if (plan.value) {
        remove_stale_temporaries_in(bake.folder);
        observer.planned(*plan.value);
        outcome = FolderMaker(bake, *plan.value, observer).make();
    } else {
        outcome.diagnostics = std::move(plan.diagnostics);
    }
    return outcome;
}

}  // namespace skybake
