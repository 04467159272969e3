#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/io/environment_io.h"

namespace prt {
namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::string& what, const std::string& name) {
    throw Error(ErrorCode::malformed, what, name);
}

json parseObject(const std::string& text, const std::string& name) {
    try {
        json document = json::parse(text);
        if (!document.is_object()) fail("is JSON, but not an object", name);
        return document;
    } catch (const json::parse_error& failure) {
        fail("is not valid JSON at byte " + std::to_string(failure.byte), name);
    } catch (const json::exception&) {
        fail("is JSON with a number that is out of range", name);
    }
}

int readBandCount(const json& document, const std::string& name) {
    const auto bands = document.find("bands");
    if (bands == document.end() || !bands->is_number_integer() || *bands < 1 ||
        *bands > kMaxLightingBandCount)
        fail("has no whole number \"bands\" from 1 to " + std::to_string(kMaxLightingBandCount),
             name);
    return bands->get<int>();
}

ShConvention readConvention(const json& document, const std::string& name) {
    const auto convention = document.find("convention");
    if (convention == document.end() || !convention->is_string())
        fail("has no text \"convention\"", name);
    const auto& text = convention->get_ref<const std::string&>();
    const std::optional<ShConvention> parsed = parseShConvention(text);
    if (!parsed) fail("has the unknown convention \"" + text + "\"", name);
    return *parsed;
}

Vec3d readCoefficient(const json& row, std::size_t index, const std::string& name) {
    const auto isFiniteNumber = [](const json& value) {
        return value.is_number() && std::isfinite(value.get<double>());
    };
    if (!row.is_array() || row.size() != 3 || !std::all_of(row.begin(), row.end(), isFiniteNumber))
        fail("has a coefficient " + std::to_string(index) + " that is not [red, green, blue]",
             name);
    return {row[0].get<double>(), row[1].get<double>(), row[2].get<double>()};
}

}  // namespace

std::string lightingToJson(const Lighting& lighting, ShConvention convention) {
    std::string text = "{\"bands\": " + std::to_string(lighting.bandCount) +
                       ", \"convention\": \"" + std::string(shConventionName(convention)) +
                       "\", \"coefficients\": [";
    const char* separator = "\n  ";
    for (const Vec3d& c : convertTo(convention, lighting).coefficients) {
        PRT_ASSERT(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z),
                   "JSON holds finite numbers only");
        text += separator + json({c.x, c.y, c.z}).dump();
        separator = ",\n  ";
    }
    return text + "\n]}\n";
}

Lighting lightingFromJson(const std::string& text, const std::string& name) {
    const json document = parseObject(text, name);
    Lighting lighting(readBandCount(document, name));
    const ShConvention convention = readConvention(document, name);
    if (lighting.bandCount > maxBandCount(convention))
        fail("has " + std::to_string(lighting.bandCount) + " bands, more than the " +
                 std::to_string(maxBandCount(convention)) + " of the convention \"" +
                 std::string(shConventionName(convention)) + "\"",
             name);
    const auto rows = document.find("coefficients");
    if (rows == document.end() || !rows->is_array() || rows->size() != lighting.coefficients.size())
        fail("does not have " + std::to_string(lighting.coefficients.size()) +
                 " \"coefficients\", the square of its bands",
             name);
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i)
        lighting.coefficients[i] = readCoefficient((*rows)[i], i, name);
    return convertFrom(convention, lighting);
}

}  // namespace prt
