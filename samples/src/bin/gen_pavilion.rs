//! Writes `samples/data/pavilion.iv` and the PNG textures. Run after changing the generator:
//! `cargo run -p samples --bin gen-pavilion`.

use std::error::Error;
use std::fs;

fn main() -> Result<(), Box<dyn Error>> {
    let data = samples::data_dir();
    let textures = data.join("textures");
    fs::create_dir_all(&textures)?;
    for (name, image) in samples::textures::all() {
        image.save(textures.join(name))?;
    }
    let model = data.join("pavilion.iv");
    fs::write(&model, samples::pavilion::document())?;
    println!("wrote {}", model.display());
    Ok(())
}
