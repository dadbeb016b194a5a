// SPDX-FileCopyrightText: The Impinge authors
// SPDX-License-Identifier: MIT

//! The surface ABI, as far as this example uses it; layout.txt beside the guide lists all of it.

use std::ffi::c_void;
use std::os::raw::c_char;
use std::ops::{Add, Mul, Neg, Sub};

pub type Status = u32;
pub const OK: Status = 0;
pub const PARAMETER: Status = 3;

pub const KIND_NUMBER: u32 = 1;
pub const KIND_INTEGER: u32 = 2;
pub const MIN_OPEN: u32 = 1;

/// One row of a type's parameter table.
#[repr(C)]
pub struct Parameter {
    pub name: *const c_char,
    pub unit: *const c_char,
    pub doc: *const c_char,
    pub default_value: *const c_char,
    pub kind: u32,
    pub flags: u32,
    pub rank: u32,
    pub extent: [u32; 3],
    pub min: f64,
    pub max: f64,
}

#[repr(C)]
pub struct Value {
    pub count: usize,
    pub extent: [usize; 3],
    pub number: *const f64,
    pub string: *const *const c_char,
}

/// The fields that a host of any version has; it never grows at the front.
#[repr(C)]
pub struct CreateError {
    pub struct_size: u32,
    pub parameter: i32,
    pub element: i64,
    pub text: [u8; 240],
}

#[repr(C)]
pub struct Region {
    pub lo: [f64; 3],
    pub hi: [f64; 3],
    pub c: [f64; 3],
    pub d: [f64; 3],
}

#[repr(C)]
pub struct RateMatrix {
    pub m: [[f64; 3]; 3],
}

/// An order-2 Taylor model of one coordinate.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Model {
    pub a: f64,
    pub b: [f64; 3],
    pub q: [f64; 6],
    pub e: f64,
    pub lo: f64,
    pub hi: f64,
    pub rate: [f64; 3],
    pub depends: u32,
    pub reserved: u32,
}

pub type Formula = unsafe extern "C" fn(*const c_void, Model, Model, Model, *mut Model);

/// Ends with `symmetry`: later fields are not used here, and struct_size says so.
#[repr(C)]
pub struct SurfaceType {
    pub struct_size: u32,
    pub parameter_count: u32,
    pub parameter_size: u32,
    pub flags: u32,
    pub name: *const c_char,
    pub summary: *const c_char,
    pub equation: *const c_char,
    pub source: *const c_char,
    pub example: *const c_char,
    pub parameters: *const Parameter,
    pub create: unsafe extern "C" fn(*const Value, *mut *mut c_void, *mut CreateError) -> Status,
    pub destroy: unsafe extern "C" fn(*mut c_void),
    pub domain: unsafe extern "C" fn(*const c_void, *mut f64, *mut f64),
    pub eval:
        unsafe extern "C" fn(*const c_void, usize, *const f64, *mut f64, *mut f64) -> Status,
    pub rate: unsafe extern "C" fn(*const c_void, *const Region, *mut RateMatrix) -> Status,
    pub include: unsafe extern "C" fn(*const c_void, *const Region, *mut Model) -> Status,
    pub net: Option<unsafe extern "C" fn()>,
    pub piece_count: unsafe extern "C" fn(*const c_void) -> usize,
    pub piece: unsafe extern "C" fn(*const c_void, usize) -> *const c_void,
    pub distance: Option<unsafe extern "C" fn()>,
    pub symmetry: Option<unsafe extern "C" fn()>,
}

#[repr(C)]
pub struct SurfaceFactory {
    pub struct_size: u32,
    pub count: u32,
    pub types: *const *const SurfaceType,
}

#[repr(C)]
pub struct Plugin {
    pub magic: u32,
    pub struct_size: u32,
    pub abi_major: u32,
    pub abi_minor: u32,
    pub name: *const c_char,
    pub version: *const c_char,
    pub license: *const c_char,
    pub author: *const c_char,
    pub get_factory: unsafe extern "C" fn(*const c_char) -> *const c_void,
}

/// Tables of constants, which all threads may read.
#[repr(transparent)]
pub struct Shared<T>(pub T);
unsafe impl<T> Sync for Shared<T> {}

#[link(name = "impinge-model", kind = "static")]
extern "C" {
    pub fn impinge_num(k: f64) -> Model;
    pub fn impinge_sincos(x: Model, sine: *mut Model, cosine: *mut Model);
    fn impinge_neg(x: Model) -> Model;
    fn impinge_add(x: Model, y: Model) -> Model;
    fn impinge_sub(x: Model, y: Model) -> Model;
    fn impinge_mul(x: Model, y: Model) -> Model;
    fn impinge_scale(x: Model, k: f64) -> Model;
    fn impinge_shift(x: Model, k: f64) -> Model;
    pub fn impinge_surface_eval(
        f: Formula, own: *const c_void, n: usize, p: *const f64, x: *mut f64, error: *mut f64,
    ) -> Status;
    pub fn impinge_surface_rate(
        f: Formula, own: *const c_void, region: *const Region, rates: *mut RateMatrix,
    ) -> Status;
    pub fn impinge_surface_include(
        f: Formula, own: *const c_void, region: *const Region, model: *mut Model,
    ) -> Status;
}

impl Neg for Model {
    type Output = Model;
    fn neg(self) -> Model {
        unsafe { impinge_neg(self) }
    }
}

impl Add for Model {
    type Output = Model;
    fn add(self, other: Model) -> Model {
        unsafe { impinge_add(self, other) }
    }
}

impl Sub for Model {
    type Output = Model;
    fn sub(self, other: Model) -> Model {
        unsafe { impinge_sub(self, other) }
    }
}

impl Mul for Model {
    type Output = Model;
    fn mul(self, other: Model) -> Model {
        unsafe { impinge_mul(self, other) }
    }
}

impl Mul<f64> for Model {
    type Output = Model;
    fn mul(self, k: f64) -> Model {
        unsafe { impinge_scale(self, k) }
    }
}

impl Add<f64> for Model {
    type Output = Model;
    fn add(self, k: f64) -> Model {
        unsafe { impinge_shift(self, k) }
    }
}

/// Sine and cosine at once.
pub fn sin_cos(x: Model) -> (Model, Model) {
    unsafe {
        let (mut sine, mut cosine) = (impinge_num(0.0), impinge_num(0.0));
        impinge_sincos(x, &mut sine, &mut cosine);
        (sine, cosine)
    }
}
