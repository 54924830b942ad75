// A Lambertian BSDF that answers plumbline (docs/protocol.md): plumbline verify --exec 'go run lambertian.go'
// With --faulty it states the pdf of uniform directions, not of those that it samples.
package main

import (
	"bufio"
	"encoding/binary"
	"fmt"
	"math"
	"os"
)

var in, out = bufio.NewReaderSize(os.Stdin, 1<<20), bufio.NewWriterSize(os.Stdout, 1<<20)
var uniform = map[bool]float64{true: 1, false: 0}[len(os.Args) > 1 && os.Args[1] == "--faulty"]

// The pdf [1/sr] and f [1/sr], without the cosine, of directions above the surface.
func pdf(wi []float64) float64  { return ((1-uniform)*wi[2] + uniform/2) / math.Pi }
func eval(wi []float64) float64 { return 0.8 / math.Pi }
func sample(u, wi []float64) {
	r, phi := math.Sqrt(u[0]), 2*math.Pi*u[1]
	wi[0], wi[1], wi[2] = r*math.Cos(phi), r*math.Sin(phi), math.Sqrt(1-u[0])
}
func readArray(values []float64) { // after a header, which is 128 bytes long
	in.Discard(128)
	binary.Read(in, binary.LittleEndian, values)
}
func writeArray(kind string, n int, columns string, values any) {
	const header = "{'descr': '%s', 'fortran_order': False, 'shape': (%d,%s), }"
	fmt.Fprintf(out, "\x93NUMPY\x01\x00\x76\x00%-117s\n", fmt.Sprintf(header, kind, n, columns))
	binary.Write(out, binary.LittleEndian, values)
}
func main() {
	fmt.Fprintln(out, `{"protocol": "plumbline/1", "name": "lambertian", "precision": "float64", "numbers": 2, "functions": ["sample", "pdf", "eval"]}`)
	next := func() string { out.Flush(); line, _ := in.ReadString('\n'); return line }
	for line, n, kind := next(), 0, ""; line != ""; line = next() {
		fmt.Sscanf(line, `{"query": %d, "kind": %q, "count": %d`, new(int), &kind, &n)
		wo, u, wi := make([]float64, 3*n), make([]float64, 2*n), make([]float64, 3*n)
		density, f, weight, accepted := make([]float64, n), make([]float64, n), make([]float64, n), make([]bool, n)
		readArray(wo)
		readArray(map[string][]float64{"sample": u, "pdf": wi, "eval": wi}[kind])
		for i := range accepted {
			w := wi[3*i : 3*i+3]
			if kind == "sample" {
				sample(u[2*i:], w)
			}
			if accepted[i] = wo[3*i+2] > 0 && w[2] > 0; accepted[i] {
				density[i], f[i], weight[i] = pdf(w), eval(w), eval(w)*w[2]/pdf(w)
			}
		}
		out.WriteString(line) // an answer begins with the line of its query
		if kind != "sample" {
			writeArray("<f8", n, "", map[string][]float64{"pdf": density, "eval": f}[kind])
			continue
		}
		writeArray("<f8", n, " 3", wi)
		writeArray("<f8", n, "", density)
		writeArray("<f8", n, "", weight)
		writeArray("|b1", n, "", accepted)
	}
}
