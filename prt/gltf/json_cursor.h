#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace prt::gltf {

using Json = nlohmann::json;

/// Parses a glTF's JSON.
///
/// @throws Error  malformed, or limitExceeded for text larger or nested deeper than any honest glTF
Json parseJson(std::string_view text);

/// A value of the file's JSON and its place in it, so that every complaint names what is wrong:
/// "accessors[5].count".
///
/// Every access checks what it takes for granted and throws Error malformed otherwise.
class JsonCursor {
  public:
    /// @param value  outlives the cursor
    JsonCursor(const Json& value, std::string place) : value_(&value), place_(std::move(place)) {}

    const std::string& place() const { return place_; }

    /// A member of this object.
    std::optional<JsonCursor> find(const char* key) const;
    JsonCursor at(const char* key) const;

    /// The elements of this array.
    std::size_t size() const;
    JsonCursor operator[](std::size_t i) const;

    /// The members of this object, by ascending name.
    std::vector<std::pair<std::string, JsonCursor>> members() const;

    double toNumber() const;
    bool toBool() const;
    const std::string& toString() const;
    /// A whole number from 0 to 2^53; 3.0 is one too.
    std::size_t toCount() const;
    /// A whole number below `count`, the number of `things`.
    std::size_t toIndex(std::size_t count, const char* things) const;
    template <std::size_t N>
    std::array<double, N> toNumbers() const;

    double numberOr(const char* key, double fallback) const;
    bool boolOr(const char* key, bool fallback) const;
    std::string stringOr(const char* key, const std::string& fallback) const;
    std::size_t countOr(const char* key, std::size_t fallback) const;
    std::optional<std::size_t> findIndex(const char* key, std::size_t count,
                                         const char* things) const;
    template <std::size_t N>
    std::array<double, N> numbersOr(const char* key, const std::array<double, N>& fallback) const;

    /// This value as JSON text.
    std::string dump() const;

    /// @throws Error  malformed, always: this place, then the complaint
    [[noreturn]] void reject(const std::string& complaint) const;

  private:
    const Json* value_;
    std::string place_;
};

/// One item for each element of the array `key`; none where it is absent.
template <class Parse>
auto parseEach(const JsonCursor& object, const char* key, Parse parse) {
    std::vector<decltype(parse(object))> items;
    const std::optional<JsonCursor> list = object.find(key);
    if (!list) return items;
    items.reserve(list->size());
    for (std::size_t i = 0; i < list->size(); ++i)
        items.push_back(parse((*list)[i]));
    return items;
}

/// How many elements the array `key` has; 0 where it is absent.
std::size_t countElements(const JsonCursor& object, const char* key);

template <std::size_t N>
std::array<double, N> JsonCursor::toNumbers() const {
    if (size() != N) reject("must have " + std::to_string(N) + " numbers");
    std::array<double, N> numbers;
    for (std::size_t i = 0; i < N; ++i)
        numbers[i] = (*this)[i].toNumber();
    return numbers;
}

template <std::size_t N>
std::array<double, N> JsonCursor::numbersOr(const char* key,
                                            const std::array<double, N>& fallback) const {
    const std::optional<JsonCursor> member = find(key);
    return member ? member->toNumbers<N>() : fallback;
}

}  // namespace prt::gltf
