#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/exchange/npy.h>

namespace plumbline::tests {
namespace {

using exchange::NpyHeader;
using exchange::NpyType;

struct Text : exchange::ByteSource {
  std::string text;
  explicit Text(std::string t) : text(std::move(t)) {}

  void read(std::byte* to, std::size_t count) override {
    if (count > text.size()) throw std::runtime_error("the text ends");
    std::memcpy(to, text.data(), count);
    text.erase(0, count);
  }
};

std::string header_of(const std::string& dictionary, char version = 1) {
  std::string text = std::string("\x93NUMPY") + version + '\0';
  const std::size_t size = dictionary.size();
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) text += static_cast<char>(size >> 8 * i & 255);
  return text + dictionary;
}

std::string error_of(const std::string& text) {
  Text source(text);
  try {
    exchange::read_npy_header(source);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(Npy, HeadersThatWeWriteAreReadAndAre128BytesLong) {
  for (const NpyHeader& header : std::vector<NpyHeader>{
           {NpyType::float32, 1, 1, 1},
           {NpyType::float64, 2, 1'000'000, 3},
           {NpyType::boolean, 1, 4'000'000'000, 1},
           {NpyType::float32, 2, 4'000'000'000, 4'000'000'000},
           {NpyType::float64, 1, 0, 1},
       }) {
    const std::string text = exchange::npy_header(header);
    EXPECT_EQ(text.size(), exchange::kNpyHeaderSize);
    EXPECT_EQ(text.back(), '\n');
    Text source(text + "data");
    EXPECT_EQ(exchange::read_npy_header(source), header);
    EXPECT_EQ(source.text, "data");
  }
}

TEST(Npy, HeadersOfOthersAreUnderstood) {
  const NpyHeader wanted{NpyType::float64, 2, 5, 3};
  for (const char* dictionary :
       {"{'descr': '<f8', 'fortran_order': False, 'shape': (5, 3), }     \n",
        "{\"shape\":(5,3),\"descr\":\"<f8\",\"fortran_order\":False}",
        " { 'fortran_order' : False , 'shape' : ( 5 , 3 , ) , 'descr' : '<f8' } \n"}) {
    for (const char version : {'\1', '\2', '\3'}) {
      Text source(header_of(dictionary, version));
      EXPECT_EQ(exchange::read_npy_header(source), wanted) << dictionary;
    }
  }
}

struct Hostile {
  std::string text;
  const char* message;
};

TEST(Npy, WhatIsNoHeaderIsSaid) {
  const std::string good = "{'descr': '<f4', 'fortran_order': False, 'shape': (5,), }\n";
  for (const Hostile& hostile : std::vector<Hostile>{
           {"", "the text ends"},
           {"hello world", "does not begin as an NPY array does"},
           {std::string("\x93NUMPY\7\0\6\0", 10), "is of a version"},
           {std::string("\x93NUMPY\1\0\xff\xff", 10) + good, "has a header of 65535 bytes; 4096"},
           {std::string("\x93NUMPY\2\0\xff\xff\xff\xff", 12), "has a header of 4294967295 bytes"},
           {header_of(good).substr(0, 40), "the text ends"},
           {header_of(""), "not understood from \"its end\""},
           {header_of("{}"), "without \"descr\""},
           {header_of("{'descr': '<f4', 'shape': (5,)}"), "without"},
           {header_of("{'descr': '>f4', 'fortran_order': False, 'shape': (5,)}"),
            "holds values of type \">f4\""},
           {header_of("{'descr': '<i8', 'fortran_order': False, 'shape': (5,)}"), "\"<i8\""},
           {header_of("{'descr': '|O', 'fortran_order': False, 'shape': (5,)}"), "\"|O\""},
           {header_of("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (5,)}"),
            "array of records"},
           {header_of("{'descr': '<f4', 'fortran_order': True, 'shape': (5,)}"), "Fortran"},
           {header_of("{'descr': '<f4', 'fortran_order': 0, 'shape': (5,)}"), "not understood"},
           {header_of("{'descr': '<f4', 'fortran_order': False, 'shape': ()}"), "no dimensions"},
           {header_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3)}"),
            "more than two dimensions"},
           {header_of("{'descr': '<f4', 'fortran_order': False, 'shape': (-5,)}"), "from \"-5"},
           {header_of("{'descr': '<f4', 'fortran_order': False, 'shape': (5.0,)}"), "from \".0"},
           {header_of("{'descr': '<f4', 'fortran_order': False, 'shape': "
                      "(99999999999999999999999,)}"),
            "more than 2^32"},
           {header_of("{'descr': '<f4', 'descr': '<f4'}"), "two of \"descr\""},
           {header_of("{'descr': '<f4', 'evil': __import__('os')}"), "unknown member \"evil\""},
           {header_of("{'descr': '<f4"), "not understood"},
           {header_of(good + "{}"), "not understood from \"{}\""},
           {header_of(std::string("{\0\xff}", 4)), "\\x00\\xff"},
       }) {
    const std::string said = error_of(hostile.text);
    EXPECT_NE(said.find(hostile.message), std::string::npos) << hostile.message << "\n" << said;
  }
}

}  // namespace
}  // namespace plumbline::tests
