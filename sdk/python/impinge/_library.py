# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""The C interface of libimpinge (<impinge/impinge.h>), as ctypes sees it.

Structs that grow begin with their size, so that a newer library runs with this module.
"""

import ctypes as c

from ._find import open_library


class Error(c.Structure):
    _fields_ = [("code", c.c_int), ("text", c.c_char * 1000)]


class Argument(c.Structure):
    _fields_ = [
        ("name", c.c_char_p),
        ("kind", c.c_uint32),
        ("rank", c.c_uint32),
        ("extent", c.c_size_t * 3),
        ("single", c.c_double),
        ("text", c.c_char_p),
        ("number", c.POINTER(c.c_double)),
        ("string", c.POINTER(c.c_char_p)),
    ]


class Options(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("audit", c.c_bool),
        ("t_start", c.c_double),
        ("t_end", c.c_double),
        ("gamma", c.c_double),
        ("gamma_clear", c.c_double),
        ("max_pairs", c.c_uint64),
        ("max_seconds", c.c_double),
        ("max_bytes", c.c_uint64),
        ("baseline", c.c_uint32),
        ("reserved", c.c_uint32),
        ("progress", c.c_void_p),
        ("progress_context", c.c_void_p),
        ("parallel", c.c_void_p),
        ("parallel_context", c.c_void_p),
    ]


class Side(c.Structure):
    _fields_ = [
        ("body", c.c_size_t),
        ("surface", c.c_size_t),
        ("piece", c.c_size_t),
        ("u", c.c_double),
        ("v", c.c_double),
        ("point", c.c_double * 3),
    ]


class Place(c.Structure):
    _fields_ = [("body", c.c_size_t), ("surface", c.c_size_t), ("piece", c.c_size_t)]


class Stats(c.Structure):
    _fields_ = [
        ("seconds", c.c_double),
        ("pairs", c.c_uint64),
        ("nodes", c.c_uint64),
        ("peak_heap", c.c_uint64),
        ("witness_searches", c.c_uint64),
        ("bytes", c.c_uint64),
    ]


class Result(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("verdict", c.c_int),
        ("reason", c.c_int),
        ("t", c.c_double),
        ("t_lower", c.c_double),
        ("gap", c.c_double),
        ("gamma", c.c_double),
        ("gamma_clear", c.c_double),
        ("a", Side),
        ("b", Side),
        ("has_normal", c.c_bool),
        ("normal", c.c_double * 3),
        ("stats", Stats),
        ("t_start", c.c_double),
        ("t_end", c.c_double),
        ("t_examined", c.c_double * 2),
        ("at_rest", c.c_bool),
        ("kind", c.c_int),
    ]


class ClearanceOptions(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("each", c.c_bool),
        ("tolerance", c.c_double),
        ("required", c.c_double),
        ("slices", c.c_uint64),
        ("decide", c.c_bool),
        ("within", c.c_double),
    ]


class Clearance(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("reason", c.c_int),
        ("verdict", c.c_int),
        ("has_witness", c.c_bool),
        ("has_normal", c.c_bool),
        ("t_start", c.c_double),
        ("t_end", c.c_double),
        ("body", c.c_size_t * 2),
        ("lower", c.c_double),
        ("upper", c.c_double),
        ("t", c.c_double),
        ("a", Side),
        ("b", Side),
        ("normal", c.c_double * 3),
        ("required", c.c_double),
        ("t_violated", c.c_double),
        ("gap_violated", c.c_double),
        ("a_violated", Side),
        ("b_violated", Side),
        ("stats", Stats),
        ("kind", c.c_int),
    ]


class Progress(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("reason", c.c_int),
        ("t_lower", c.c_double),
        ("pairs", c.c_uint64),
        ("heap", c.c_uint64),
        ("seconds", c.c_double),
        ("lower", c.c_double),
        ("upper", c.c_double),
        ("gap", c.c_double),
    ]


class Parameter(c.Structure):
    _fields_ = [
        ("name", c.c_char_p),
        ("unit", c.c_char_p),
        ("doc", c.c_char_p),
        ("default_value", c.c_char_p),
        ("kind", c.c_uint32),
        ("flags", c.c_uint32),
    ]  # as far as it is read here; a table's rows are parameter_size bytes apart


class TypeInfo(c.Structure):
    _fields_ = [
        ("kind", c.c_int),
        ("name", c.c_char_p),
        ("summary", c.c_char_p),
        ("equation", c.c_char_p),
        ("source", c.c_char_p),
        ("example", c.c_char_p),
        ("file", c.c_char_p),
        ("plugin", c.c_char_p),
        ("version", c.c_char_p),
        ("license", c.c_char_p),
        ("author", c.c_char_p),
        ("shadowed_by", c.c_char_p),
        ("parameters", c.c_void_p),
        ("parameter_count", c.c_size_t),
        ("parameter_size", c.c_size_t),
        ("capabilities", c.c_char_p),
        ("formula", c.c_char_p),
    ]


class SceneParameter(c.Structure):
    _fields_ = [("name", c.c_char_p), ("lo", c.c_double), ("hi", c.c_double), ("is_followed", c.c_bool)]


class SurveyOptions(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("any", c.c_bool),
        ("body", c.c_size_t * 2),
        ("max_boxes", c.c_uint64),
        ("sink", c.c_void_p),
        ("sink_context", c.c_void_p),
        ("resume", c.c_char_p),
        ("lo", c.c_void_p),
        ("hi", c.c_void_p),
    ]


class SurveyState(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("reason", c.c_int),
        ("boxes", c.c_uint64),
        ("waiting", c.c_uint64),
        ("proved", c.c_double),
        ("t_upper", c.c_double),
        ("pairs_of_bodies", c.c_size_t),
        ("has_worst", c.c_bool),
        ("worst_body", c.c_size_t * 2),
        ("worst_time", c.c_double * 2),
    ]


class Stage(c.Structure):
    _fields_ = [("kind", c.c_int), ("type", c.c_char_p), ("identity", c.c_void_p)]


CLEAR, CONTACT, UNDECIDED = 0, 1, 2  # imp_verdict
RESOLUTION, RUNNING = 7, 8  # imp_reason
LIMITS = (3, 4, 5, 6, RUNNING)  # imp_reason: of what has not been answered
REQUIREMENT_NONE, REQUIREMENT_UNDECIDED = 0, 3  # imp_requirement
PARAMETER_FILE = 1 << 4  # IMP_PARAMETER_FILE

_P, _S, _D, _N = c.c_void_p, c.c_char_p, c.c_double, c.c_size_t
_E, _A = c.POINTER(Error), c.POINTER(Argument)

ProofSink = c.CFUNCTYPE(None, _P, _P, _N)  # imp_proof_sink

# Name: result, arguments.
_FUNCTIONS = {
    "imp_version": (_S,),
    "imp_registry_new": (_P, _S),
    "imp_registry_free": (None, _P),
    "imp_registry_type": (c.c_bool, _P, _N, c.POINTER(TypeInfo)),
    "imp_scene_from_json": (_P, _P, _S, _N, _S, _E),
    "imp_scene_from_file": (_P, _P, _S, _E),
    "imp_scene_from_pair": (_P, _P, _S, _S, _E),
    "imp_pair_to_json": (_P, _P, _S, _S, _E),
    "imp_scene_free": (None, _P),
    "imp_scene_body_count": (_N, _P),
    "imp_scene_body_name": (_S, _P, _N),
    "imp_scene_surface_count": (_N, _P, _N),
    "imp_scene_eval": (c.c_int, _P, _N, _N, _N, _P, _P, _P, _E),
    "imp_scene_piece_count": (_N, _P, _N, _N),
    "imp_piece_eval": (c.c_int, _P, Place, _N, _P, _P, _P, _E),
    "imp_piece_domain": (None, _P, Place, _P, _P),
    "imp_piece_stage_count": (_N, _P, Place),
    "imp_piece_stage": (c.c_int, _P, Place, _N, _P, _E),
    "imp_piece_formula": (c.c_int, _P, Place, _N, c.POINTER(_P), _E),
    "imp_builder_new": (_P, _P),
    "imp_builder_free": (None, _P),
    "imp_builder_time": (c.c_int, _P, _D, _D, _E),
    "imp_builder_gamma": (c.c_int, _P, _D, _D, _E),
    "imp_builder_parameter": (c.c_int, _P, _S, _D, _D, _E),
    "imp_builder_bodies_of": (c.c_int, _P, _P, _E),
    "imp_builder_body": (c.c_int, _P, _S, c.POINTER(_N), _E),
    "imp_builder_solid": (c.c_int, _P, _N, c.c_bool, _E),
    "imp_builder_surface": (c.c_int, _P, _N, _S, _A, _N, _E),
    "imp_builder_map": (c.c_int, _P, _N, _S, _A, _N, _E),
    "imp_builder_surface_of": (c.c_int, _P, _N, _P, _N, _N, _E),
    "imp_builder_surface_map": (c.c_int, _P, _N, _N, _S, _A, _N, _E),
    "imp_builder_parent": (c.c_int, _P, _N, _N, _E),
    "imp_builder_group": (c.c_int, _P, _N, _S, _E),
    "imp_builder_ignore": (c.c_int, _P, _S, _S, _E),
    "imp_builder_finish": (_P, _P, _E),
    "imp_scene_set_values": (c.c_int, _P, _N, _N, _N, _A, _N, _E),
    "imp_scene_parameter": (c.c_bool, _P, _N, c.POINTER(SceneParameter)),
    "imp_scene_at": (_P, _P, c.POINTER(_D), _E),
    "imp_survey_options_get_default": (c.c_int, c.POINTER(SurveyOptions), _E),
    "imp_survey_new": (_P, _P, c.POINTER(Options), c.POINTER(ClearanceOptions), c.POINTER(SurveyOptions), _E),
    "imp_survey_free": (None, _P),
    "imp_survey_step": (c.c_int, _P, c.c_uint64, _E),
    "imp_survey_cancel": (None, _P),
    "imp_survey_get_result": (c.c_int, _P, c.POINTER(Result), _E),
    "imp_survey_get_clearance": (c.c_int, _P, _P, _E),
    "imp_survey_refine": (c.c_int, _P, _D, _D, _E),
    "imp_survey_values": (c.c_bool, _P, _P),
    "imp_survey_get_state": (c.c_int, _P, c.POINTER(SurveyState), _E),
    "imp_options_get_default": (c.c_int, _P, c.POINTER(Options), _E),
    "imp_scene_ignores": (c.c_bool, _P, _N, _N),
    "imp_query_new": (_P, _P, c.POINTER(Options), _E),
    "imp_query_get_result": (c.c_int, _P, c.POINTER(Result), _E),
    "imp_query_refine": (c.c_int, _P, _D, _D, _E),
    "imp_query_exclude_pair": (c.c_int, _P, _E),
    "imp_query_cancel": (None, _P),
    "imp_query_divide": (c.c_int, _P, c.POINTER(_N), _E),
    "imp_query_part": (_P, _P, _N, _E),
    "imp_clearance_options_get_default": (c.c_int, c.POINTER(ClearanceOptions), _E),
    "imp_clearance_new": (_P, _P, c.POINTER(Options), c.POINTER(ClearanceOptions), _E),
    "imp_clearance_count": (_N, _P),
    "imp_clearance_get": (c.c_int, _P, _N, _P, _E),
    "imp_query_step": (c.c_int, _P, c.c_uint64, _E),
    "imp_query_keep_proof": (c.c_int, _P, _E),
    "imp_query_write_proof": (c.c_int, _P, _S, ProofSink, _P, _E),
    "imp_survey_keep_proof": (c.c_int, _P, _E),
    "imp_survey_write_proof": (c.c_int, _P, _S, ProofSink, _P, _E),
    "imp_scene_sources": (_P, _P, _E),
    "imp_query_free": (None, _P),
}


def _load() -> c.CDLL:
    loaded = open_library()
    for name, (result, *arguments) in _FUNCTIONS.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


def _find_free() -> "c._FuncPointer":
    function = c.CDLL(None).free
    function.restype, function.argtypes = None, [c.c_void_p]
    return function


library = _load()
free = _find_free()  # of texts that the library hands over
