// Nothing of a manifest can be changed without `verify` telling it, and where.
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/assets/occupancy/occupancy_check.h"
#include "bakers/assets/registry/probe_check.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/verify.h"
#include "tests/incremental/bakes.h"

namespace skybake {
namespace altered_manifest_test {
namespace {

using namespace skybake::testing;
using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// A table and a volume; that they are few and small keeps the walk short.
constexpr const char* recipe_text = R"(
preset = "earth_hillaire"
[bake.transmittance]
size = [16, 4]
[noise.shape.channels.Y]
type = "worley"
frequency = 4
[clouds.c]
noise = "shape"
extent = ["6 km", "6 km", "3 km"]
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [4, 4, 4]
formats = ["exr"]
)";

Json baked_manifest(const std::filesystem::path& folder) {
    const std::string more = std::string(recipe_text) +
                             "[bake.density]\nasset = \"optical_depth\"\n" +
                             "table = \"density\"\nsize = [8, 1, 1]\n";
    EXPECT_EQ(TestBake(recipe_of(more), folder).states().size(), 3U);
    EXPECT_EQ(TestBake(recipe_of(recipe_text), folder).states().size(), 2U);
    return Json::parse(read_bytes(folder / "manifest.json"));
}

// All places of a document but the whole, scalars and others.
void add_places(const Json& json, const Pointer& at, std::vector<Pointer>& places) {
    if (!at.empty()) places.push_back(at);
    if (json.is_object()) {
        for (const auto& [key, value] : json.items()) add_places(value, at / key, places);
    } else if (json.is_array()) {
        for (std::size_t i = 0; i < json.size(); ++i) add_places(json[i], at / i, places);
    }
}

Json altered(const Json& scalar) {
    if (scalar.is_string()) return scalar.get<std::string>() + "x";
    if (scalar.is_boolean()) return !scalar.get<bool>();
    if (scalar.is_null()) return false;
    if (scalar.is_number_unsigned()) return scalar.get<std::uint64_t>() + 1;
    if (scalar.is_number_integer()) return scalar.get<std::int64_t>() + 1;
    return scalar.get<double>() + 1;
}

// Two probes of each asset show what all of them do, in a tenth of the time.
Json with_few_probes(Json json) {
    for (Json& asset : json["assets"]) {
        Json& probes = asset["probes"];
        while (probes.size() > 2) probes.erase(probes.size() - 1);
        asset["hash"] = entry_hash(asset);
    }
    json["hash"] = manifest_hash(json);
    return json;
}

Json without(Json json, const Pointer& at) {
    Json& parent = json[at.parent_pointer()];
    if (parent.is_array()) {
        parent.erase(std::stoul(at.back()));
    } else {
        parent.erase(at.back());
    }
    return json;
}

// An element of an array a second time.
Json with_twin(Json json, const Pointer& at) {
    Json& array = json[at.parent_pointer()];
    const auto i = static_cast<Json::difference_type>(std::stoul(at.back()));
    array.insert(array.begin() + i, Json(array[std::stoul(at.back())]));
    return json;
}

// The text of the whole where a key of an object stands a second time, before the first, which is
// what many readers of JSON would not see.
std::string text_with_key_twice(Json json, const Pointer& at) {
    Json both = Json::object();
    for (const auto& [key, value] : json[at.parent_pointer()].items()) {
        if (key == at.back()) both["@twin"] = nullptr;
        both[key] = value;
    }
    json[at.parent_pointer()] = std::move(both);
    std::string text = json.dump();
    return text.replace(text.find("@twin"), 5, at.back());
}

// Expects `verify` to tell of it: by a diagnostic that names a place, or a failed hash of the right entry.
void expect_told(const Json& json, const Pointer& at, const char* what) {
    const auto manifest = parse_manifest(json.dump(), "manifest.json");
    if (!manifest.value) {
        EXPECT_EQ(first_code(manifest.diagnostics), "E0304") << what << at;
        EXPECT_NE(manifest.diagnostics.at(0).message.find(": `"), std::string::npos)
            << manifest.diagnostics[0].message;
        return;
    }
    ASSERT_FALSE(manifest.value->alterations.empty()) << what << at;
    const std::string place = at.to_string();
    const bool in_entry = place.starts_with("/assets/") && place.find('/', 8) != std::string::npos;
    const std::string wanted =
        in_entry ? "`assets[" + place.substr(8, place.find('/', 8) - 8) + "]`" : "the manifest ";
    EXPECT_TRUE(manifest.value->alterations[0].starts_with(wanted))
        << what << at << ": " << manifest.value->alterations[0];
}

// "/assets/0/probes/3/uv/1" is of the kind "/assets/probes/uv".
std::string kind_of(const Pointer& at) {
    std::string kind;
    std::string text = at.to_string();
    for (std::size_t from = 0; from != std::string::npos;) {
        const std::size_t to = text.find('/', from + 1);
        const std::string part = text.substr(from, to == std::string::npos ? to : to - from);
        if (part.find_first_not_of("/0123456789") != std::string::npos) kind += part;
        from = to;
    }
    return kind;
}

TEST(AlteredManifest, EveryValueIsUnderAHash) {
    const TemporaryFolder folder;
    const Json json = with_few_probes(baked_manifest(folder.path()));
    ASSERT_EQ(json["retired"].size(), 1U);
    std::vector<Pointer> places;
    add_places(json, Pointer(), places);
    std::size_t scalars = 0;
    for (const Pointer& at : places) {
        if (json[at].is_primitive()) {
            ++scalars;
            Json changed = json;
            changed[at] = altered(json[at]);
            ASSERT_NE(changed[at], json[at]) << at;
            expect_told(changed, at, "altered ");
        }
        if (json[at].is_object()) {
            Json more = json;
            more[at]["extra"] = 1;
            expect_told(more, at / "extra", "added ");
        }
        expect_told(without(json, at), at, "deleted ");
        if (json[at.parent_pointer()].is_array()) {
            expect_told(with_twin(json, at), at, "doubled ");
            continue;
        }
        const auto twice = parse_manifest(text_with_key_twice(json, at), "manifest.json");
        ASSERT_EQ(first_code(twice.diagnostics), "E0304") << at;
        EXPECT_EQ(twice.diagnostics[0].message, "cannot read `manifest.json` as a manifest: `" +
                                                    at.back() + "` stands twice in one object");
    }
    EXPECT_GT(scalars, 200U);
    EXPECT_TRUE(parse_manifest(json.dump(), "manifest.json").value->alterations.empty());
}

// The same through all that `verify` does, for one value of each kind.
TEST(AlteredManifest, VerifyFails) {
    const TemporaryFolder folder;
    const Json json = baked_manifest(folder.path());
    const std::array checks = {probe_check()};
    const std::array of_folder = {skipping_check()};
    const auto verify = [&] { return verify_bake(folder.path(), checks, of_folder); };
    ASSERT_TRUE(verify().value->failures.empty());
    std::vector<Pointer> places;
    add_places(json, Pointer(), places);
    std::set<std::string> kinds;
    for (const Pointer& at : places) {
        if (!json[at].is_primitive() || !kinds.insert(kind_of(at)).second) continue;
        Json changed = json;
        changed[at] = altered(json[at]);
        write_bytes(folder / "manifest.json", changed.dump(2));
        const auto report = verify();
        if (!report.value) {
            EXPECT_EQ(first_code(report.diagnostics), "E0304") << at;
            continue;
        }
        ASSERT_FALSE(report.value->failures.empty()) << at;
        EXPECT_EQ(report.value->failures[0].file, "manifest.json") << at;
        EXPECT_EQ(report.value->failures[0].check, "hash") << at;
    }
    EXPECT_GT(kinds.size(), 60U);
    write_bytes(folder / "manifest.json", json.dump());  // other spaces alone
    EXPECT_TRUE(verify().value->failures.empty());
}

// A bake never builds on what somebody has changed.
TEST(AlteredManifest, ABakeMakesAllAnew) {
    const TemporaryFolder folder;
    Json json = baked_manifest(folder.path());
    json["assets"][0]["conventions"]["solar_irradiance"] = 2;
    json["assets"][0]["content"] = "something else";
    write_bytes(folder / "manifest.json", json.dump(2));
    TestBake again(recipe_of(recipe_text), folder.path());
    EXPECT_EQ(again.states(), std::vector<AssetState>());  // a list is wanted: damage, E0303
    json["assets"][0]["conventions"]["solar_irradiance"] = {2};
    write_bytes(folder / "manifest.json", json.dump(2));
    EXPECT_EQ(again.states(), std::vector<AssetState>(2, AssetState::baked));
    EXPECT_EQ(again.observer.reasons.at(0),
              std::vector<std::string>{"manifest.json has been changed since the last bake"});
    EXPECT_TRUE(verify_bake(folder.path()).value->failures.empty());
    EXPECT_EQ(again.states(), std::vector<AssetState>(2, AssetState::up_to_date));
}

TEST(AlteredManifest, ABakeReplacesAnEarlierFormat) {
    const TemporaryFolder folder;
    Json json = baked_manifest(folder.path());
    json["format"] = 1;
    json["tool"]["version"] = "0.0.9";
    json.erase("hash");
    for (Json& asset : json["assets"]) asset.erase("conventions");
    write_bytes(folder / "manifest.json", json.dump(2));
    const auto refused = verify_bake(folder.path());
    ASSERT_EQ(first_code(refused.diagnostics), "E0304");
    EXPECT_NE(refused.diagnostics[0].message.find("bake the recipe into this folder again"),
              std::string::npos);
    TestBake again(recipe_of(recipe_text), folder.path());
    EXPECT_EQ(again.states(), std::vector<AssetState>(2, AssetState::baked));
    EXPECT_EQ(again.observer.reasons.at(1),
              std::vector<std::string>{"manifest.json is of an earlier format"});
    EXPECT_TRUE(verify_bake(folder.path()).value->failures.empty());
    EXPECT_EQ(read_manifest(folder.path()).value->retired.size(), 1U);
}

}  // namespace
}  // namespace altered_manifest_test
}  // namespace skybake
