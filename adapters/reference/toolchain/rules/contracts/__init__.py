"""The rules of 9.2: data types, constants, interfaces and annotations."""
