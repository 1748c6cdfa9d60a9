// Intermediates are what several assets are made from, made once for all of them: solved light, tables
// of sunlight, voxels of clouds.
//
// A plan says beforehand what each asset will need. An intermediate is made by the asset that asks
// for it first, and freed after the last one that was expected to ask. Only equal needs share one:
// a finer one in its place would change texels, which then would depend on what else is baked.
#pragma once

#include <any>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skybake {

// All that an intermediate depends on: a value of any type that can be copied and compared.
class NeedKey {
  public:
    template <class Key>
    explicit NeedKey(Key key)
        : value_(std::move(key)), equals_([](const std::any& one, const std::any& other) {
              const auto* second = std::any_cast<Key>(&other);
              return second != nullptr && *std::any_cast<Key>(&one) == *second;
          }) {}

    friend bool operator==(const NeedKey& one, const NeedKey& other) {
        return one.equals_(one.value_, other.value_);
    }

  private:
    std::any value_;
    bool (*equals_)(const std::any& one, const std::any& other);
};

// Something that an asset is made from.
struct Need {
    NeedKey key;
    std::string name;       // "solved light", for people
    double seconds = 0;     // an estimate: on one thread of a machine of 2022
    double memory_mib = 0;  // taken while it is kept
};

// Bytes that one run keeps for those after it. Several threads may use one.
class KeptBytes {
  public:
    // What the bytes depend on, and nothing else.
    struct Name {
        std::string kind;  // "convection"
        int version = 0;   // of what makes them
        std::string parameters;
    };
    virtual ~KeptBytes() = default;
    // Returns nothing if there are none, or if they are damaged.
    virtual std::optional<std::string> find(const Name& name) = 0;
    virtual void keep(const Name& name, std::string_view bytes) = 0;
};

// Returns so many numbers that an earlier run has kept, or make(), which is kept unless it is empty. Null
// keeps nothing.
template <class Number>
std::vector<Number> kept_or_made(KeptBytes* kept, const KeptBytes::Name& name, std::size_t count,
                                 const std::function<std::vector<Number>()>& make) {
    if (const auto bytes = kept != nullptr ? kept->find(name) : std::nullopt;
        bytes && bytes->size() == count * sizeof(Number)) {
        std::vector<Number> numbers(count);
        std::memcpy(numbers.data(), bytes->data(), bytes->size());
        return numbers;
    }
    std::vector<Number> numbers = make();
    if (kept == nullptr || numbers.empty()) return numbers;
    const auto* bytes = reinterpret_cast<const char*>(numbers.data());
    kept->keep(name, {bytes, numbers.size() * sizeof(Number)});
    return numbers;
}

// Several threads may use one. Those that ask for an intermediate which another one makes wait for
// it. The one that makes it never waits for them, even if all of them ask within a parallel loop: a
// loop within a loop runs its own tasks only (parallel.h).
class Intermediates {
  public:
    // Keeps at most so many bytes. What does not fit is made anew for each asset. `kept` may be null.
    explicit Intermediates(std::int64_t most_bytes, KeptBytes* kept = nullptr);
    ~Intermediates();
    Intermediates(const Intermediates&) = delete;
    Intermediates& operator=(const Intermediates&) = delete;

    // An asset that is expected to ask for some needs, until this object is destroyed.
    class Expected {
      public:
        Expected() = default;
        Expected(Intermediates& owner, std::vector<Need> needs);
        Expected(Expected&& other) noexcept;
        Expected& operator=(Expected&& other) noexcept;
        ~Expected();

      private:
        Intermediates* owner_ = nullptr;
        std::vector<Need> needs_;
    };
    [[nodiscard]] Expected expect(std::vector<Need> needs) { return {*this, std::move(needs)}; }

    // Returns make(), or what it returned to somebody else. `make` returns null if it was
    // interrupted; then the next one that asks makes the value. A value that nobody is expected to
    // ask for is not kept.
    template <class Value>
    std::shared_ptr<const Value> get(const NeedKey& key,
                                     const std::function<std::shared_ptr<const Value>()>& make) {
        return std::static_pointer_cast<const Value>(
            get_any(key, [&make]() -> std::shared_ptr<const void> { return make(); }));
    }

    // Whether others than the one that asks want it, or have made it.
    bool is_shared(const NeedKey& key) const;

    // Where makers may look for what an earlier run made, and leave it for the next; null: nowhere.
    KeptBytes* kept() const { return kept_; }

    // The number of values that were made for assets that were expected.
    int made() const;
    std::int64_t kept_bytes() const;

  private:
    struct Node;
    using Maker = std::function<std::shared_ptr<const void>()>;
    std::shared_ptr<const void> get_any(const NeedKey& key, const Maker& make);
    void add(const Need& need);
    void remove(const Need& need);
    std::shared_ptr<Node> find(const NeedKey& key) const;
    void finish(Node& node, const std::shared_ptr<const void>& value);

    const std::int64_t most_bytes_;
    KeptBytes* const kept_;
    mutable std::mutex mutex_;  // guards all members below, and the nodes
    std::condition_variable made_one_;
    std::vector<std::shared_ptr<Node>> nodes_;
    std::int64_t kept_bytes_ = 0;
    int made_ = 0;
};

// Returns what `shared` has for the key, or make() if it is null.
template <class Value>
std::shared_ptr<const Value> shared_or_made(
    Intermediates* shared, const NeedKey& key,
    const std::function<std::shared_ptr<const Value>()>& make) {
    return shared != nullptr ? shared->get<Value>(key, make) : make();
}

}  // namespace skybake
