// SPDX-FileCopyrightText: The Impinge authors
// SPDX-License-Identifier: MIT

// Tells the linker where libimpinge-model.a is, as pkg-config says.
fn main() {
    let said = std::process::Command::new("pkg-config")
        .args(["--variable=libdir", "impinge-sdk"])
        .output()
        .expect("pkg-config cannot be run");
    assert!(said.status.success(), "pkg-config does not find impinge-sdk; set PKG_CONFIG_PATH");
    let folder = String::from_utf8(said.stdout).expect("the folder's name is not UTF-8");
    println!("cargo:rustc-link-search=native={}", folder.trim());
}
