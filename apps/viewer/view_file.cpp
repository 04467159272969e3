// Bibliography
//   [Hoffman14]  JSON merge patch
#include "apps/viewer/view_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "apps/common/ringing.h"
#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::viewer {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMostBytes = 1 << 24;
constexpr int kMostDepth = 8;

/// Where a number may lie.
struct Range {
    double low = std::numeric_limits<double>::lowest();
    double high = std::numeric_limits<double>::max();
};

constexpr Range kStops{-100.0, 100.0};

/// The names of an enumeration's values, in their sequence.
template <std::size_t count>
using Names = std::array<std::string_view, count>;

constexpr Names<3> kContentNames = {"relit", "coefficient", "reference"};

/// Puts the fields of a view into JSON.
class Writer {
  public:
    json take() { return std::move(fields_); }

    template <class Value>
    void field(const char* name, Value& value, Range = {}) {
        fields_[name] = write(value);
    }
    template <class Value, std::size_t count>
    void choice(const char* name, Value& value, const Names<count>& names) {
        fields_[name] = names[static_cast<std::size_t>(value)];
    }
    void word(const char* name, std::string& value, const Names<4>&) { fields_[name] = value; }

  private:
    static json write(bool value) { return value; }
    static json write(int value) { return value; }
    static json write(std::size_t value) { return value; }
    static json write(double value) { return value; }
    static json write(float value) { return json::parse(fmt::format("{}", value)); }
    static json write(std::string& value) { return value; }
    static json write(Vec3d& value) { return {value.x, value.y, value.z}; }
    static json write(cli::ShownTransport value) { return cli::shownTransportName(value); }
    static json write(ToneCurve value) { return toneCurveName(value); }
    template <class Value>
    static json write(std::optional<Value>& value) {
        return value ? write(*value) : json();
    }
    template <class Value>
    static json write(std::vector<Value>& values) {
        json array = json::array();
        for (Value& value : values)
            array.push_back(write(value));
        return array;
    }
    template <class Struct>
    static json write(Struct& value);

    json fields_ = json::object();
};

/// Takes the fields of a view from JSON; what is absent stays as it is.
class Reader {
  public:
    /// @param place  of the object in the document, for errors
    Reader(const json& object, std::string where, std::string place)
        : object_(object), where_(std::move(where)), place_(std::move(place)) {
        if (!object.is_object()) fail("an object");
    }

    /// After all fields: every name of the object is one of theirs.
    void finish() const {
        for (const auto& [name, value] : object_.items())
            if (std::find(known_.begin(), known_.end(), name) == known_.end())
                throw Error(ErrorCode::malformed,
                            fmt::format("has a '{}' that no view has", at(name)), where_);
    }

    template <class Value>
    void field(const char* name, Value& value, Range range = {}) {
        if (const json* found = find(name)) Reader(*found, where_, at(name), range).read(value);
    }
    template <class Value, std::size_t count>
    void choice(const char* name, Value& value, const Names<count>& names) {
        if (const json* found = find(name))
            value = static_cast<Value>(Reader(*found, where_, at(name), Range{}).findName(names));
    }
    void word(const char* name, std::string& value, const Names<4>& names) {
        if (const json* found = find(name))
            value = names[Reader(*found, where_, at(name), Range{}).findName(names)];
    }

  private:
    /// Of a single value.
    Reader(const json& value, const std::string& where, std::string place, Range range)
        : object_(value), where_(where), place_(std::move(place)), range_(range) {}

    [[noreturn]] void fail(const std::string& expected) const {
        throw Error(
            ErrorCode::malformed,
            fmt::format("has {} that is not {}", place_.empty() ? "a view" : place_, expected),
            where_);
    }

    std::string at(const std::string& name) const {
        return place_.empty() ? name : place_ + "." + name;
    }

    const json* find(const char* name) {
        known_.push_back(name);
        const auto found = object_.find(name);
        return found == object_.end() ? nullptr : &*found;
    }

    template <std::size_t count>
    std::size_t findName(const Names<count>& names) const {
        const auto found = object_.is_string()
                               ? std::find(names.begin(), names.end(), object_.get<std::string>())
                               : names.end();
        if (found == names.end()) fail(fmt::format("one of {}", fmt::join(names, ", ")));
        return static_cast<std::size_t>(found - names.begin());
    }

    double readNumber(const char* kind) const {
        const double number = object_.is_number() ? object_.get<double>() : std::nan("");
        if (!(number >= range_.low && number <= range_.high))
            fail(range_.low > Range().low
                     ? fmt::format("{} of {} … {}", kind, range_.low, range_.high)
                     : std::string(kind));
        return number;
    }

    void read(bool& value) const {
        if (!object_.is_boolean()) fail("true or false");
        value = object_.get<bool>();
    }
    void read(double& value) const { value = readNumber("a number"); }
    void read(float& value) const { value = static_cast<float>(readNumber("a number")); }
    template <class Integer>
    void readInteger(Integer& value) const {
        const double number = object_.is_number_integer() ? readNumber("a whole number") : -1.5;
        if (number < 0.0 || number > 1e9) fail("a whole number");
        value = static_cast<Integer>(number);
    }
    void read(int& value) const { readInteger(value); }
    void read(std::size_t& value) const { readInteger(value); }
    void read(std::string& value) const {
        if (!object_.is_string()) fail("a text");
        value = object_.get<std::string>();
    }
    void read(Vec3d& value) const {
        if (!object_.is_array() || object_.size() != 3) fail("three numbers");
        for (int axis = 0; axis < 3; ++axis)
            Reader(object_[static_cast<std::size_t>(axis)], where_, place_, Range{})
                .read(value[axis]);
    }
    /// @param parse  turns a text into an optional value
    template <class Value, class Parse>
    void readNamed(Value& value, const Parse& parse, const char* forms) const {
        const auto parsed = object_.is_string() ? parse(object_.get<std::string>()) : std::nullopt;
        if (!parsed) fail(std::string("one of ") + forms);
        value = *parsed;
    }
    void read(cli::ShownTransport& value) const {
        readNamed(value, cli::parseShownTransport, cli::kShownTransportForms);
    }
    void read(ToneCurve& value) const { readNamed(value, parseToneCurve, "none|aces|neutral"); }
    template <class Value>
    void read(std::optional<Value>& value) const {
        if (object_.is_null()) {
            value.reset();
            return;
        }
        if (!value) value.emplace();
        read(*value);
    }
    template <class Value>
    void read(std::vector<Value>& values) const {
        if (!object_.is_array()) fail("an array");
        values.assign(object_.size(), {});
        for (std::size_t i = 0; i < values.size(); ++i)
            Reader(object_[i], where_, fmt::format("{}[{}]", place_, i), Range{}).read(values[i]);
    }
    template <class Struct>
    void read(Struct& value) const;

    const json& object_;
    std::string where_;
    std::string place_;
    Range range_{};
    std::vector<std::string> known_{};
};

// ── The names of all fields, for both directions ─────────────────────────────────────────────────

template <class Fields>
void describe(Fields& fields, ObjectChoice& object) {
    fields.field("asset", object.asset);
    fields.field("rotation_degrees", object.rotationDegrees);
    fields.field("shown", object.isShown);
}

template <class Fields>
void describe(Fields& fields, LightChoice& light) {
    fields.field("light", light.source);
    fields.field("stops", light.stops, kStops);
    fields.field("azimuth_degrees", light.azimuthDegrees);
    fields.field("on", light.isOn);
}

template <class Fields>
void describe(Fields& fields, CameraPose& pose) {
    fields.field("target", pose.target);
    fields.field("distance", pose.distance, {1e-9, 1e9});
    fields.field("azimuth_degrees", pose.azimuthDegrees);
    fields.field("elevation_degrees", pose.elevationDegrees, {-90.0, 90.0});
    fields.field("fov_degrees", pose.fovDegrees, {1.0, 170.0});
}

template <class Fields>
void describe(Fields& fields, Pane& pane) {
    fields.choice("content", pane.content, kContentNames);
    fields.field("transport", pane.transport);
    fields.field("bands", pane.bandCount, {1, kMaxBandCount});
    fields.field("coefficient", pane.coefficient, {0, shCoefficientCount(kMaxBandCount) - 1});
}

template <class Fields>
void describe(Fields& fields, PickedVertex& picked) {
    fields.field("object", picked.object);
    fields.field("vertex", picked.vertex);
}

template <class Fields>
void describe(Fields& fields, ViewState& view) {
    fields.field("objects", view.objects);
    fields.field("lights", view.lights);
    fields.field("light_rotation_degrees", view.lightRotationDegrees);
    fields.word("window", view.window, cli::kWindowNames);
    fields.field("camera", view.camera);
    fields.field("left", view.left);
    fields.field("right", view.right);
    fields.field("split_position", view.splitPosition, {0.0, 1.0});
    fields.field("auto_exposure", view.autoExposure);
    fields.field("exposure_stops", view.display.exposureStops, kStops);
    fields.field("tone", view.display.toneCurve);
    fields.field("background", view.showBackground);
    fields.field("wire_frame", view.wireFrame);
    fields.field("light_lobe", view.showLightLobe);
    fields.field("transfer_lobe", view.showTransferLobe);
    fields.field("picked", view.picked);
}

template <class Struct>
json Writer::write(Struct& value) {
    Writer writer;
    describe(writer, value);
    return writer.take();
}

template <class Struct>
void Reader::read(Struct& value) const {
    Reader fields(object_, where_, place_);
    describe(fields, value);
    fields.finish();
}

json writeView(ViewState view) {
    Writer writer;
    describe(writer, view);
    return writer.take();
}

ViewState readView(const json& document, const std::string& where) {
    ViewState view;
    Reader reader(document, where, {});
    describe(reader, view);
    reader.finish();
    return view;
}

json parseJson(const std::string& text, const std::string& where) {
    // What follows goes down into the document by recursion.
    const auto stopDeepDown = [&](int depth, json::parse_event_t, json&) {
        if (depth > kMostDepth)
            throw Error(ErrorCode::malformed, "is JSON of more levels than a view has", where);
        return true;
    };
    try {
        return json::parse(text, stopDeepDown);
    } catch (const json::parse_error& failure) {
        throw Error(ErrorCode::malformed,
                    "is not valid JSON at byte " + std::to_string(failure.byte), where);
    } catch (const json::exception&) {
        throw Error(ErrorCode::malformed, "is JSON with a number that is out of range", where);
    }
}

std::string readText(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path, kMostBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

ScriptStep readStep(const json& step, std::size_t number, const std::string& where) {
    const auto fail = [&](const char* what) {
        throw Error(ErrorCode::malformed, fmt::format("step {} {}", number, what), where);
    };
    if (!step.is_object()) fail("is not an object");
    ScriptStep read;
    for (const auto& [name, value] : step.items()) {
        if (name == "view" && value.is_object())
            read.patch = value.dump();
        else if (name == "screenshot" && value.is_string())
            read.screenshot = value.get<std::string>();
        else
            fail("has more than a \"view\", which is an object, and a \"screenshot\", a file");
    }
    return read;
}

}  // namespace

std::string formatView(const ViewState& view) {
    return writeView(view).dump(2) + "\n";
}

ViewState parseView(const std::string& text, const std::string& where) {
    return readView(parseJson(text, where), where);
}

void saveView(const std::filesystem::path& path, const ViewState& view) {
    writeFileAtomically(path, formatView(view));
}

ViewState loadView(const std::filesystem::path& path) {
    return parseView(readText(path), path.string());
}

std::vector<ScriptStep> loadScript(const std::filesystem::path& path) {
    const std::string where = path.string();
    const json document = parseJson(readText(path), where);
    if (!document.is_array()) throw Error(ErrorCode::malformed, "is not an array of steps", where);
    std::vector<ScriptStep> steps;
    for (const json& step : document)
        steps.push_back(readStep(step, steps.size() + 1, where));
    return steps;
}

ViewState applyPatch(const ViewState& view, const std::string& patch, const std::string& where) {
    if (patch.empty()) return view;
    json document = writeView(view);
    document.merge_patch(parseJson(patch, where));
    return readView(document, where);
}

}  // namespace prt::viewer
