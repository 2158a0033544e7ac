// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// hri._native: the core without OpenCV. Exception classes are made here and shared with
// hri._native_vision.
#include <pybind11/pybind11.h>

#include "core/errors.hpp"
#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"
#include "hri/core/version.hpp"

namespace py = pybind11;

void bind_option_field(py::module_& m);
void bind_files(py::module_& m);
void bind_resample(py::module_& m);
void bind_wavelets(py::module_& m);
void bind_filter_bank(py::module_& m);
void bind_stationary(py::module_& m);
void bind_end_points(py::module_& m);
void bind_wavelet_tools(py::module_& m);
void bind_speech_features(py::module_& m);
void bind_hand_shapes(py::module_& m);
void bind_hand_pair(py::module_& m);
void bind_two_hand_features(py::module_& m);
void bind_motion_features(py::module_& m);
void bind_hand_features(py::module_& m);
void bind_hand_sources(py::module_& m);
void bind_codebook(py::module_& m);
void bind_classifiers(py::module_& m);
void bind_logistic_regression(py::module_& m);
void bind_sequence_network(py::module_& m);
void bind_softmax_regression(py::module_& m);
void bind_hmm(py::module_& m);
void bind_possibilistic(py::module_& m);
void bind_language(py::module_& m);
void bind_recognition(py::module_& m);
void bind_speaker_adapter(py::module_& m);
void bind_speech_embedding(py::module_& m);
void bind_gesture_segments(py::module_& m);
void bind_connected_words(py::module_& m);
void bind_htk_files(py::module_& m);
void bind_htk_models(py::module_& m);
void bind_htk_training(py::module_& m);
void bind_subwords(py::module_& m);
void bind_sentences(py::module_& m);

namespace {

// Never released: exception classes live as long as the process.
PyObject* g_invalid_argument = nullptr;
PyObject* g_format_error = nullptr;
PyObject* g_io_error = nullptr;
PyObject* g_interrupted = nullptr;

// Makes the class `name` with the bases (hri Error, a builtin), so that both "except" clauses catch
// it.
PyObject* make_error(py::module_& m, const char* name, PyObject* base, PyObject* builtin,
                     const char* doc) {
  py::list bases;
  bases.append(py::handle(base));
  if (builtin != nullptr) bases.append(py::handle(builtin));
  const std::string qualified = std::string("hri._native.") + name;
  PyObject* type =
      PyErr_NewExceptionWithDoc(qualified.c_str(), doc, py::tuple(bases).ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  m.attr(name) = py::handle(type);
  return type;
}

void bind_errors(py::module_& m) {
  PyObject* root = make_error(m, "Error", PyExc_Exception, nullptr, "Root of hri's errors.");
  g_invalid_argument = make_error(m, "InvalidArgument", root, PyExc_ValueError,
                                  "A value outside its documented range.");
  g_format_error =
      make_error(m, "FormatError", root, PyExc_ValueError, "A file breaks its format.");
  g_io_error = make_error(m, "IoError", root, PyExc_OSError,
                          "The operating system refused a file operation.");
  g_interrupted = make_error(m, "Interrupted", PyExc_KeyboardInterrupt, nullptr,
                             "Training was interrupted; nothing was kept.");
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const hri::InvalidArgument& e) {
      hri_bind::raise(g_invalid_argument, e);
    } catch (const hri::FormatError& e) {
      hri_bind::raise(g_format_error, e);
    } catch (const hri::IoError& e) {
      hri_bind::raise(g_io_error, e);
    } catch (const hri::Interrupted& e) {
      // A pending KeyboardInterrupt raised by the stop check would otherwise be reported twice.
      PyErr_Clear();
      PyErr_SetString(g_interrupted, e.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_native, m) {
  m.doc() =
      "libhri's core: signal, features, models, language, recognition and HTK's files, without "
      "OpenCV.";
  m.attr("__version__") = HRI_VERSION;
  bind_errors(m);
  m.def(
      "set_num_threads", &hri::set_num_threads, py::arg("count"),
      "At most this many threads train from now on, in this process; 0 (as at the start): one for "
      "each processor.\n\nWhat is trained is the same to the bit for any number.");
  m.def("num_threads", &hri::num_threads, "How many threads train, as set.");
  bind_option_field(m);
  bind_files(m);
  bind_resample(m);
  bind_wavelets(m);
  bind_filter_bank(m);
  bind_stationary(m);
  bind_end_points(m);
  bind_wavelet_tools(m);
  bind_speech_features(m);
  bind_hand_shapes(m);
  bind_hand_pair(m);
  bind_two_hand_features(m);
  bind_motion_features(m);
  bind_hand_features(m);
  bind_hand_sources(m);
  bind_codebook(m);
  bind_classifiers(m);
  bind_logistic_regression(m);
  bind_sequence_network(m);
  bind_softmax_regression(m);
  bind_hmm(m);
  bind_possibilistic(m);
  bind_language(m);
  bind_recognition(m);
  bind_speaker_adapter(m);
  bind_speech_embedding(m);
  bind_gesture_segments(m);
  bind_connected_words(m);
  bind_htk_files(m);
  bind_htk_models(m);
  bind_htk_training(m);
  bind_subwords(m);
  bind_sentences(m);
}
