#include "io/files/json_text.h"

#include <set>
#include <utility>
#include <vector>

namespace etude {
namespace {

constexpr int kNumberOverflow = 406;  // nlohmann's id of this error

class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(JsonText& built) : built_(built) {}

  bool null() override { return Add(nullptr); }
  bool boolean(bool value) override { return Add(value); }
  bool number_integer(number_integer_t value) override { return Add(value); }
  bool number_unsigned(number_unsigned_t value) override { return Add(value); }
  bool number_float(number_float_t value, const string_t&) override { return Add(value); }
  bool string(string_t& value) override { return Add(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // JSON has no binary values

  bool start_object(std::size_t) override {
    keys_.emplace_back();
    return Open(Json::object());
  }
  bool start_array(std::size_t) override { return Open(Json::array()); }
  bool key(string_t& name) override {
    if (!keys_.back().insert(name).second && !built_.repeated_key) built_.repeated_key = name;
    key_ = std::move(name);
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    return end_array();
  }
  bool end_array() override {
    open_.pop_back();
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const Json::exception& error) override {
    built_.fault = {byte, error.id == kNumberOverflow};
    return false;
  }

 private:
  // Pointers to open lists and objects stay valid, because each open list or object is the last entry of its parent
  // until it is closed.
  Json& Place(Json value) {
    if (open_.empty()) return built_.value = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_array()) return parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
    // Appends to ordered_json's list of pairs, without looking up the key.
    std::vector<std::pair<const std::string, Json>>& pairs = parent.get_ref<Json::object_t&>();
    return pairs.emplace_back(std::move(key_), std::move(value)).second;
  }
  bool Add(Json value) {
    Place(std::move(value));
    return true;
  }
  bool Open(Json value) {
    open_.push_back(&Place(std::move(value)));
    return true;
  }

  JsonText& built_;
  std::vector<Json*> open_;
  std::vector<std::set<std::string>> keys_;  // the keys seen so far in each open object
  std::string key_;
};

}  // namespace

JsonText ParseJsonText(std::string_view text) {
  JsonText built;
  Builder builder(built);
  Json::sax_parse(text, &builder);
  return built;
}

}  // namespace etude
