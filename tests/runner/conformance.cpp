// SPDX-License-Identifier: Apache-2.0
// Conformance tests, tests/conformance/**.st: the promises of the language, feature by feature. Line 1 says what the
// test shows; projects in **.xml use comments such as <!-- features: 54/2a -->
//   // features: 43/1a 43/1b      rows of the standard's tables, at most six
//   // covers: tm-tp-library:SR    rows of the manuals' catalogues; codesys:NAME where no manual lists it
//   // covers: rule:tm-tp:NAME     rules of the manuals, rules.tsv
//   // with: doubles.nct           files of its folder that belong to the project
// A file without `// expect:` lines is run by `rung test`, many files in one process, each as a separate project, once
// for each way (interpreted and compiled, -O0 and -O1); every {test} POU counts. A file with them is checked like a
// golden file. A file with a body in C++ is only compiled. Sessions in **.test show what outlives a run: console.cpp.
#include <algorithm>
#include <map>
#include <set>

#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {

Result runDiagnosticsTest(const Setting& setting, const std::string& file);  // golden.cpp

namespace {

constexpr size_t kBatch = 40;  // files of one `rung test`: few enough to keep two processors busy
constexpr size_t kMaxFeatures = 6;

struct File {
  std::string path, features, covers;
  std::vector<std::string> others;  // of its project
  bool is_native = false;           // has a body in C++, which cannot be interpreted
};

struct TestCase {
  std::string file, name, failure;
  bool failed;
};

std::string unescaped(std::string text) {
  const std::pair<const char*, const char*> entities[] = {{"&lt;", "<"},   {"&gt;", ">"},   {"&quot;", "\""},
                                                          {"&apos;", "'"}, {"&#10;", "\n"}, {"&amp;", "&"}};
  for (const auto& [entity, character] : entities) {
    for (size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1)) {
      text.replace(at, std::string(entity).size(), character);
    }
  }
  return text;
}

std::string attribute(const std::string& tag, const std::string& name) {
  const size_t at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return {};
  const size_t start = at + name.size() + 3;
  return unescaped(tag.substr(start, tag.find('"', start) - start));
}

// The test cases of a JUnit file: <testcase file=… name=…/> with <failure> or <error> inside when it failed.
std::vector<TestCase> readJunit(const std::string& xml) {
  std::vector<TestCase> cases;
  size_t at = 0;
  while ((at = xml.find("<testcase ", at)) != std::string::npos) {
    const size_t tag_end = xml.find('>', at);
    if (tag_end == std::string::npos) break;
    const std::string tag = xml.substr(at, tag_end - at);
    TestCase test{attribute(tag, "file"), attribute(tag, "name"), {}, false};
    if (test.file.empty()) test.file = attribute(tag, "classname");
    if (tag.back() != '/') {
      const size_t end = std::min(xml.find("</testcase>", tag_end), xml.size());
      const std::string body = xml.substr(tag_end + 1, end - tag_end - 1);
      test.failed = body.find("<failure") != std::string::npos || body.find("<error") != std::string::npos;
      for (const std::string element : {"failure", "error"}) {
        for (size_t f = body.find('<' + element); f != std::string::npos; f = body.find('<' + element, f + 1)) {
          const size_t text = std::min(body.find('>', f), body.size() - 1) + 1;
          for (const std::string& line :
               splitLines(unescaped(body.substr(text, body.find("</" + element, text) - text))))
            if (!trimmed(line).empty()) test.failure += "  " + line + "\n";
        }
      }
    }
    cases.push_back(std::move(test));
    at = tag_end;
  }
  return cases;
}

Command testCommand(const Setting& setting, const std::vector<File>& files, const std::string& options,
                    const std::string& junit) {
  Command c;
  c.arguments = {setting.rung, "test"};
  for (const std::string& word : splitWords(options)) c.arguments.push_back(word);
  if (files.size() > 1) c.arguments.push_back("--separate");
  c.arguments.insert(c.arguments.end(), {"--root", "."});
  if (kSanitized) c.arguments.insert(c.arguments.end(), {"--timeout", "T#10m"});
  if (!junit.empty()) c.arguments.insert(c.arguments.end(), {"--junit", junit});
  for (const File& file : files) {
    c.arguments.push_back(file.path);
    c.arguments.insert(c.arguments.end(), file.others.begin(), file.others.end());
  }
  c.folder = setting.root;
  c.seconds = 600;
  return c;
}

void add(Result& all, Result part) {
  all.passed += part.passed;
  all.failed += part.failed;
  all.log += part.log;
  all.rows.insert(all.rows.end(), part.rows.begin(), part.rows.end());
}

// Counts the results that one process reports, and leaves in `files` those without a result.
Output runOnce(const Setting& setting, std::vector<File>& files, const std::string& options, Result& result) {
  const std::string junit = freshFolder(setting) + "/junit.xml";
  Output output = run(testCommand(setting, files, options, junit));
  std::set<std::string> seen;
  for (const TestCase& test : readJunit(readContent(junit))) {
    const auto owner =
        std::find_if(files.begin(), files.end(), [&](const File& file) { return test.file == file.path; });
    if (owner == files.end()) continue;
    seen.insert(owner->path);
    result.rows.push_back({owner->path, test.name, !test.failed, owner->features, owner->covers});
    if (!test.failed) {
      result.pass();
      continue;
    }
    Command again = testCommand(setting, {*owner}, options, "");
    again.arguments.insert(again.arguments.end(), {"--filter", test.name});
    const std::string what = test.failure.empty() ? (output.out + output.err).substr(0, 4000) : test.failure;
    result.fail(owner->path + ": " + test.name + " (" + options + ")", what, commandLine(again));
  }
  std::erase_if(files, [&](const File& file) { return seen.count(file.path) != 0; });
  return output;
}

Result runBatch(const Setting& setting, std::vector<File> files, const std::string& options) {
  Result result;
  const size_t count = files.size();
  const Output output = runOnce(setting, files, options, result);
  if (files.empty()) {
    // Every file has a result; an exit code that contradicts them is a separate failure.
    if (output.exit_code != (result.failed == 0 ? 0 : 4)) {
      result.fail("conformance (" + options + ")",
                  "  exit code " + std::to_string(output.exit_code) + "\n" + output.err, "");
    }
  } else if (count == 1) {
    const std::string what =
        "  no test ran, exit code " + std::to_string(output.exit_code) + "\n" + output.err + output.out;
    result.fail(files[0].path + " (" + options + ")", what.substr(0, 4000),
                commandLine(testCommand(setting, files, options, "")));
    result.rows.push_back({files[0].path, "", false, files[0].features, files[0].covers});
  } else {
    // A file that does not build, or that ends the process, hides the results of others: halving finds it in few runs.
    const auto middle = files.begin() + static_cast<std::ptrdiff_t>(files.size() / 2);
    if (files.begin() != middle) add(result, runBatch(setting, {files.begin(), middle}, options));
    add(result, runBatch(setting, {middle, files.end()}, options));
  }
  return result;
}

std::string headProblem(const std::vector<std::string>& lines, const File& file) {
  std::string problem = purposeProblem(lines);
  if (file.features.empty() && file.covers.empty()) problem += "  there is no `// features:` or `// covers:` line\n";
  const size_t named = splitWords(file.features).size();
  if (named > kMaxFeatures)
    problem += "  the file names " + std::to_string(named) + " features; at most six are allowed\n";
  return problem;
}

}  // namespace

void addConformance(const Setting& setting, std::vector<Job>& jobs) {
  std::map<std::string, std::vector<File>> by_options;
  std::vector<std::string> paths = filesBelow(setting, "tests/conformance", ".st");
  const std::vector<std::string> projects = filesBelow(setting, "tests/conformance", ".xml");
  paths.insert(paths.end(), projects.begin(), projects.end());
  for (const std::string& path : paths) {
    const std::vector<std::string> lines = splitLines(readContent(setting.root + "/" + path));
    File file{path, valueOf(lines, "features"), valueOf(lines, "covers"), {}};
    for (const std::string& name : splitWords(valueOf(lines, "with")))
      file.others.push_back(folderOf(path) + "/" + name);
    file.is_native = std::find(lines.begin(), lines.end(), "{C++}") != lines.end();
    if (const std::string problem = headProblem(lines, file); !problem.empty()) {
      jobs.push_back({path, 0, [path, problem] {
                        Result result;
                        result.fail(path, problem, "");
                        return result;
                      }});
    }
    if (!valuesOf(lines, "expect").empty()) {
      jobs.push_back({path, 0, [&setting, file] {
                        Result result = runDiagnosticsTest(setting, file.path);
                        result.rows.push_back({file.path, "", result.failed == 0, file.features, file.covers});
                        return result;
                      }});
    } else if (!file.others.empty()) {
      for (const std::string& way : setting.ways) {
        const std::string options = trimmed(way + " " + valueOf(lines, "args"));
        if (!setting.update)
          jobs.push_back(
              {path + " " + options, 1, [&setting, file, options] { return runBatch(setting, {file}, options); }});
      }
    } else if (!setting.update) {
      by_options[valueOf(lines, "args")].push_back(std::move(file));
    }
  }
  for (const auto& [options, all] : by_options) {
    for (const std::string& way : setting.ways) {
      std::vector<File> files = all;
      if (way.find("--engine=interp") != std::string::npos)
        std::erase_if(files, [](const File& file) { return file.is_native; });
      const size_t batches = (files.size() + kBatch - 1) / kBatch;
      for (size_t i = 0; i < batches; ++i) {
        std::vector<File> batch;  // every n-th file: equal work in each batch
        for (size_t k = i; k < files.size(); k += batches) batch.push_back(files[k]);
        const std::string all_options = trimmed(way + " " + options);
        jobs.push_back({"conformance " + all_options, static_cast<int>(batch.size()),
                        [&setting, batch, all_options] { return runBatch(setting, batch, all_options); }});
      }
    }
  }
}

}  // namespace rung::tests
